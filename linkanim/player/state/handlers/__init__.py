"""What each action makes of a state, by subject; `linkanim.player.state.actions` lists them."""
