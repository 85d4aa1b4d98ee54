"""The window on a screen: what is drawn of a state and where it is clicked, devices, the loop.

From the ground up; a module imports from those before it only:

    pointing  what is under the mouse, and the words about it
    shown     the state as an overlay
    pictures  the picture of a state, at rest or on its way
    screen    the display, and what is painted on it
    devices   keyboard, touch, gamepads, mouse
    desktop   what the desktop asks of every program
    window    the loop
"""
