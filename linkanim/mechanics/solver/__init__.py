"""How a linkage is closed, pose by pose and over a whole cycle; only `mechanics` imports from here.

From the ground up; a module imports from those before it only:

    input        the input at one instant, and its path over the phase
    signed_root  roots that keep their sign through limits, and where they vanish
    loop         dyads on a crank pin and something fixed; the ranges they leave
    strokes      cylinders and sliders that drive
    following    links that are solved together, followed in certified steps
    courses      their motion as polynomials of the phase
    closing      every kind of joint, and one walk over all of them
    assembly     a linkage put together: its loops, its path, its signs
    limits       limits and change points further down the chain
"""
