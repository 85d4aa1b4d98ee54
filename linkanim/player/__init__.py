"""What is behind the window: keys, the pure state and its modes, tapes, files.

From the ground up; a module imports from those before it only:

    clock      phase as a closed form of the integer frame
    action     what can be asked of the player, as plain data
    browsing   what is found by typed words; the shelf, and where each of its mechanisms stands
    keys       the one table of keys and gamepad buttons
    state      all that one frame of the window shows, and what a mode is
    helping    a mode that is seen through: the help
    rules      what values actions may have
    commands   the bar of commands, and menus
    framing    what a state's picture is fitted to, and the states that were left
    sight      what is where in the picture that was drawn last
    hand       what a mode asks of the hand on the mouse, and of the window
    edits      actions that show another scene; a mode: the list of dimensions
    making     two modes: the steps of a construction; layers in which a scene can be made
    sketching  what the pencil and poses share: answers come, one is kept
    dial       the pencil's dial, from the most exact answer to the most compact
    on_sheet   a sheet as it is drawn
    building   two modes: the sheet, on which a linkage is built, and the list of dimensions on it
    listing    a mode: the list of quantities, or of commands
    finding    a mode: one field that finds anything
    stored     what tapes and lessons have stored: a scene, a look
    lesson     a lesson's steps and their file; a mode: the line for a caption
    shelving   a mode: the shelf
    reassembling  a mode: all closures of the scene, one of which becomes the scene
    pencil     a mode: a stroke is drawn, and linkages that follow it come
    posing     a mode: poses of a body are set down, and linkages that pass them come
    naming     a mode: the name of the file to be written
    record_dialog  a mode: how a recording is made, and where it goes
    bands      a mode: the band within which traced points stay
    ruler      a mode: how far two places are apart, and in which direction
    modes      all modes, and the one table of their keys
    actions    the table of actions, and `advance(state, actions)`
    tape       what was done, frame by frame
    tape_file  a tape as a file
    files      files that the window writes
    background  processes beside the window: a search, a recording
"""
