"""The window on a screen: panels drawn from a state and where they are clicked, devices, the loop.

From the ground up; a module imports from those before it only:

    pointing  what is under the mouse, and the words about it
    pictures  the picture of a state, at rest or on its way, and what is drawn beside its scene
    tools     the bar of tools
    command_icons  the icons of commands
    command_bar    the bar of commands at the foot
    panels    help, lists, words at the foot, marks of state: all panels of a state
    shelf     linkages as small live pictures: the shelf, and the row of a sketch's answers
    screen    the display, and what is painted on it
    devices   keyboard, touch, gamepads, mouse
    desktop   what the desktop asks of every program
    window    the loop
"""
