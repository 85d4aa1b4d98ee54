"""What is played with linkages; it stands on all that shows them.

The frame for games lies below, in the player, which knows no game by name:

- `player.state.Game` is the protocol: a frozen value that answers actions (`carried`), grows older by
  frames (`aged`) and puts what it shows into the overlay (`shown`). It is handed the whole state and
  returns one: the scene, clock and look that it wants are the state's own, and its own fields are whatever
  it keeps (score, streak, frames). `player.actions.with_scene` puts a scene on, `leave` goes back to what
  was beneath.
- While a game is on every action is handed to it, but for those of `player.actions.BESIDE` (theme, help,
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
  `player.sound`. All are left out when a tape is played.
- What is shown is `picture.overlay.GamePanel` (heading, scores, lines, answers, bars, a verdict) in
  the room of a list, and `Spot`s on the picture; curves can be had from `Overlay.path`.

From the ground up; a module imports from those before it only:

    games      a game's words, the table of games, and what they share
    question   a question about a linkage at a pose
    kinds      the one table of kinds of questions
    quiz       rounds of questions, printed with their key
    platforms  rounds of questions as learning platforms take them
    menus      the title, the games, the rounds to choose from
    predict    a question, then the motion shows the answer
    follow     a ram is kept between two lines
    match      a curve is matched by dragging joints
    scores     the file of best scores
    arcade     what a window is given of games and scores
"""
