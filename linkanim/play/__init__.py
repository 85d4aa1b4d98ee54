"""Games with linkages, built on the rooms that show them.

The frame for games is in the player, which knows no game by name:

- `player.state.Game` is the protocol: a frozen value that answers actions (`carried`), grows older by
  frames (`aged`) and says what it draws in the picture (`drawn`) and in its `panel`. It is given the whole
  state and returns a state: scene, clock and look are the state's own; the game's fields are what it keeps
  itself (score, streak, frames). `player.actions.with_scene` shows a scene, `leave` goes back to the state
  beneath.
- While a game runs every action is handed to it, except those of `player.actions.BESIDE` (theme, help,
  zoom, full screen, recording). Keys give "option" (1–9, a click on an answer in the panel or a spot in the
  picture), "next" (Enter, Space, any other letter, a click elsewhere), "turn" (← →), "raise" (↑ ↓), "back"
  (Esc); the crank pin that is dragged gives "scrub", as without a game. Other actions come as their keys
  have them.
- A game begins from its `words`, such as `predict chapter=four-bars level=2 seed=7`, and `words` also
describe
  it at any moment: they are the value of the action "play", so a tape that starts within a game continues it
  from there. `games.game_of` reads them; a new game is a module with `read(words)`, named in its table.
- What only the outside knows (a seed, best scores, missed questions) is asked for by the effect "begin" with
  words that lack it; the window has `Arcade.completed` fill them in and carries out "play" with the completed
  words, which the tape keeps. The effect "score" passes on a result to be kept. Both effects are left out
  when a tape is played.
- A game shows a `picture.game_panel.GamePanel` (heading, scores, lines, answers, bars, a verdict) in the
  room of a list, and `Spot`s on the picture; a curve is a `Stroke` that it draws.

From the ground up; a module imports from those before it only:

    games      a game's words, the table of games, and what games share
    question   a question about a linkage at a pose
    kinds      the one table of kinds of questions
    quiz       rounds of questions, printed with their key
    platforms  rounds of questions in the formats of learning platforms
    menus      the title, the games, the rounds to choose from
    predict    a question, then the motion shows the answer
    follow     a ram is kept between two lines
    match      a curve is matched by dragging joints
    scores     the file of best scores
    arcade     the games and scores that a window is given
"""
