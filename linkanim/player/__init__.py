"""The window: keys, the pure state behind it, tapes and the loop.

From the ground up; a module imports from those before it only:

    clock      phase as a closed form of the integer frame
    action     what can be asked of the player, as plain data
    keys       the one table of keys and gamepad buttons
    state      all that one frame of the window shows
    commands   the bar of commands, and menus
    edits      another scene is put on; dimensions are edited
    sketching  what a stroke and poses share: answers come, one is kept
    dial       along the front, from the exact answer to the compact one
    pencil     a stroke is drawn
    posing     poses are set down
    building   a linkage is built on the sheet
    making     how a linkage was found, step by step, and the layers in which it can be made
    taking     how a recording is made, and where it goes
    actions    the table of actions, and `advance(state, actions)`
    tape       what was done, frame by frame
    tape_file  a tape as a file
    sound      cues, their waves, the loudspeaker
    pointing   what is under the mouse tells itself
    shown      the state in the words of the overlay
    stroke_view  the view of a stroke and its linkage
    framing    the picture that fits a state, and the way to the next one
    screen     the display, and what is on it
    devices    keyboard, touch, gamepads, mouse
    files      files that the window writes
    beside     processes beside the window: a search, a recording
    window     the loop
"""
