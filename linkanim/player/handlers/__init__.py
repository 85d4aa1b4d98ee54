"""What each action makes of a state, by subject; `linkanim.player.actions` lists them."""
