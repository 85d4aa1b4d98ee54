"""What is played with linkages; it stands on all that shows them.

The frame for games lies below, in the player, which knows no game by name:

- `player.state.state.Game` is the protocol: a frozen value that answers actions (`carried`), grows older by
  frames (`aged`) and puts what it shows into the overlay (`shown`). It is handed the whole state and
  returns one: the scene, clock and look that it wants are the state's own, and its own fields are whatever
  it keeps (score, streak, frames). `handlers.games.with_scene` puts a scene on, `leave` goes back to what
  was beneath.
- While a game is on every action is handed to it, but for those of `handlers.games.BESIDE` (theme, help,
  zoom, full screen, recording). Keys give "option" (1–9, a click on an answer in the panel or a spot in the
  picture), "next" (Enter, Space, any other letter, a click elsewhere), "turn" (← →), "raise" (↑ ↓), "back"
  (Esc); the crank pin that is dragged gives "scrub", as without a game. Other actions come as their keys
  have them.
- `words` is what a game begins from, such as `predict chapter=four-bars level=2 seed=7`, and what it is at
  any moment: the action "play" has them, so a tape that begins in the midst of a game begins it just there.
  `games.game_of` reads them; a new game is a module with `read(words)`, named in its table.
- What only the outside knows (a seed, best scores, what was missed) is asked for by the effect "begin" with
  words that lack it; the window has `Arcade.completed` fill them in and carries out "play" with the whole
  words, which the tape keeps. The effect "score" hands on what is to be kept, "sound" is a cue of
  `player.sound.cues`. All are left out when a tape is played.
- What is shown is `picture.panels.overlay.GamePanel` (heading, scores, lines, answers, bars, a verdict) in
  the room of a list, and `Spot`s on the picture; curves can be had from `Overlay.path`.

From the ground up: `words` and `choosing`; `question`, its `kinds`, a `round` of them, a printed `sheet`,
`chapters`; then the pages, `title`, `lobby` and `menu`, and what is played, `predict`, `match`, `follow`;
`games`, the table of them; `scores`, the file, and `arcade`, what a window is given of both.
"""
