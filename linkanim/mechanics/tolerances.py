"""What counts as nothing, as one, or as near: every tolerance of the room, with its unit and its reason.

Its parts, in reading order:

- Lengths, as shares of the lengths beside them: what of a length its last digits cannot tell.
- Margins and factors of a dyad, as shares of their greatest value: what is none, or has no digits.
- Places of the input, in phase or in radians: what is one place, and how near a search comes.
- Links that are solved together: when they are solved, and back.
- Values and rates, as shares of their usual size: what is rounding.
"""


# Lengths, as shares of the lengths beside them: what of a length its last digits cannot tell.

NO_LEVER = 2.0**-50
"""Share of a bar's length below which a lever is none: the last digits of the phase."""
FAR = 64.0
"""How many times as far from (0, 0) as a linkage is large its pins may lie for it to be solved from there."""
ONE_POINT = 1e-12
"""Share of the size of a body within which two of its joints are one point."""
EQUALLY_FAR = 1e-9
"""Distances that differ by less than this share of the course's size are equal."""
TWO_FLOATS = 2.0**-100
"""Share below which the difference of two sums of two floats is rounding."""
ROUNDED_LENGTHS = 2.0**-48
"""Share of the longest bar by which rounded lengths may be off: within it bars just fall into line."""
NEARLY_A_KITE = 1 / 4
"""Share of the longest by which ground and crank, and the two bars, differ at most next to a kite."""
GAP = 2.0**-53
"""Share of the perimeter below which a sum of signed lengths is none: it is the rounding of the lengths."""
MARKED = 2.0**-51
"""Share of the coordinates that a length comes from within which it is the length that it is near."""
KITE = 2.0**-51
"""Share of the perimeter that rounded lengths of a kite may differ by."""
CHANGE_POINT = 1e-12
"""Share of the perimeter within which rounded lengths are told to be those of a change point."""
EQUAL_LINKS = 1e-15
"""Share of its length within which a link is told to be as long as another."""
PARALLEL = 1e-6
"""Share of the ground by which the coupler of a parallelogram may be off it."""
CLOSE = 2.0**-8
"""Share of the perimeter's square below which the least U or W needs all digits of the lengths: beside a
larger one, rounded as it is, bars in one line are right to some last digits."""
CLOSEST = 2.0**-44
"""The same share below which it is none: the lengths may be those of a change point."""


# Margins and factors of a dyad, as shares of their greatest value: what is none, or has no digits.

NONE_LEFT = 1e-12
"""A factor below this share of its greatest value, in a dyad whose bars fall into one line, is none."""
CLEAR = 0.1
"""The sine of the angle between two bars below which they may fall into one line between two samples."""
TOUCHING = 1e-12
"""Share of a margin's scale within which floats cannot tell its sign, where the pins are near the origin."""
OFF = 2.0**-46
"""The same share for pins as far from the origin as the longest bar is long, taken where it is the larger: it
grows with that distance, as coordinates lose digits of a bar."""
BARELY = 1 / 64
"""Share of its greatest value below which a margin that turns back costs results their digits."""
LOW = 1 / 8
"""The same where a margin rises from a limit: it costs rates, which lose twice as many, more digits."""
FLAT = 2.0**-52
"""Share of a margin's scale by which it changes between samples that need no others between them."""
USED_UP = 1e-10
"""A margin below this share of its greatest value is at its limit."""
NO_DIGITS = 1e-40
"""Share of a margin's scale below which it has no digits left."""
NARROWEST = 1e-4
"""The narrowest stretch of a fit, in phase: beside a narrower one the margin itself would have no digits."""
NARROWEST_AT_A_LIMIT = 1e-12
"""The same at a limit, beside which the margin grows the faster, the nearer another limit lies behind it."""
LAST = 1e-17
"""Share of the first coefficient that a fit's last ones should not exceed."""
LAST_BEYOND = 1e-19
"""The same of fits that do not begin at a zero: by their rates they are off some hundred times as much."""
TOLERABLE = 1e-13
"""Share that they must not exceed: rounded constants leave kinks of 1e-16 where a loop changes its side."""
WIDE = 1 / 16
"""Share of K above which U is its greatest value less K sin²(ψ/2)."""
SMALLEST = 1e-300
"""A factor below this is divided by as if it were this: what is multiplied by it vanishes, too."""


# Places of the input, in phase or in radians: what is one place, and how near a search comes.

STATED = 2.0**-51
"""Share of a phase, or of half a turn where that is more, by which a stated phase may be off."""
BESIDE_AN_EXTREME = 2.0**-40
"""Share of the phase to which an extreme is found: the value there is off by the square of that."""
FOUND = 1e-9
"""How closely a search finds the phase of the least angle (rad)."""
SAME_PLACE = 1e-9
"""Places of the input that differ by less are one, and ranges equally wide: angles in radians, travels as a
share of the whole."""
TURNING_WITH_IT = 1e-4
"""In phase: a body that turns back this near to an end of the input turns back with it."""
ASIDE = 1e-3
"""How far beside a place, in phase, is looked at a path of which no rates say how it bends there."""
NARROW = 1e-13
"""The width at which a bracket is narrow enough, in radians of phase."""
FINEST = 2.0**-70
"""Share of the largest place below which a bracket is not halved further: a place may be zero itself."""
JUST_AFTER = 1e-6
"""Phase at which a closure is judged where it is ambiguous at the start itself."""
BESIDE_AN_END = 1e-3
"""Sine of a place's phase below which half the way to the swing's end gives all digits of the distance."""
AT_END = 1e-6
"""In phase: so near to where the input turns back, a dyad's separation is extreme without touching, and power
and pace may both have no digits."""
NEARLY_ZERO = 1e-8
"""Half a last digit of this number is more than the error of a limit."""
NUDGE = 1e-15
"""How far beside a place, in phase and fifty digits, a margin is taken for its slope and bend there."""
CONVERGED = 1e-25
"""A step of Newton's method for a zero or an extreme, in fifty digits, below which it is found."""
SETTLED = 1e-24
"""A step for the limit of a loop, in fifty digits, after which the next is below all digits."""
NEARBY = 1e-6
"""How far a zero may lie from where floats found it, in phase."""
NO_WAY = 1e-5
"""In phase: a narrower swing is a single place, and so are places known to few digits that differ by less."""
NO_RANGE = 1e-12
"""Ranges that overlap by no more than this, in radians, touch."""
OWN_LIMIT = 1e-15
"""A limit within this angle of the end of a swing is that end."""


# Links that are solved together: places in lengths of the linkage, turns in radians.

NO_STEP = 1e-7
"""A step along the closure shorter than this is none: two closures meet there."""
SOLVED = 1e-13
"""A correction of links that are solved together below which they are solved, in floats."""
GUESSED = 1e-10
"""The same before they are solved to 38 digits: the correction there starts from about the square of this."""
SOLVED_TO_ALL_DIGITS = 1e-30
"""What the next correction in 38 digits would be at the most, by the last two."""
LIMIT_SOLVED = 1e-34
"""A correction of a limit, in 38 digits, below which it is found."""
AT_LIMIT = 2.0**-50
"""How far from a limit a stated end of the input may be, and be that limit, in lengths of the linkage."""
APART = 1e-3
"""How far from the ends of a group's path, in radians, the limits of a dyad beside it are at the least."""
BESIDE_A_LIMIT = 1e-14
"""What is added to the squares of equations that leave Newton's step open, as they do at a limit."""
ONE_CLOSURE = 1e-6
"""What two solutions from different starts differ by, and are one closure."""
SAME_POSE = 1e-9
"""What a pose may be off another one, and be the same: the closure that is followed is back."""


# Values and rates, as shares of their usual size: what is rounding.

RIGID = 2.0**-44
"""A rate below this share of its separation is rounding."""
ROUNDING = 1e-13
"""Share of its usual size below which a number is rounding: of the linkage's extent, moved at the input's
speed, or of the mean size of what is summed."""
STRAIGHT = 1e-12
"""Share below which a cross product of velocity and acceleration, or a turn of a link, is rounding."""
FEWER_ERRORS = 1e-2
"""Share of an acceleration's usual rounding errors that is left where all its terms are small."""
SLOW = 1 / 16
"""Rates have fewer digits of what moves by less, in extents of the linkage for each radian of the input."""
IDLE = 10.0
"""Power, or a moment, of no more than this many times its rounding errors is none."""
NO_SHARE = 1e-12
"""A counterweight of less than this share of the coupler's moment is none."""
LEVEL = 1e-9
"""Share of a quantity's greatest size; a quantity that changes by less stands still."""
UNEVEN = 0.1
"""How far the change of a rate may be off the one that its slopes make, where it has no sharper bend."""
STANDSTILL = 2.0**-40
"""The share of the rates around it below which a rate is nothing but rounding."""
CANCELLED = 16.0
"""A sum counts as cancelled where its square times this is below the square of its terms' difference."""
