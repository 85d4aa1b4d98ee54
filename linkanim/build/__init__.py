"""A linkage built by hand on an empty sheet: a frozen draft, the gestures that change it, what it comes to.

From the ground up; a module imports from those before it only:

    draft       what has been drawn, and how its things are named
    places      which dyad each joint is; places to numbers and back; the shapes to be seen of a draft
    freedom     the degrees of freedom of a drawing, and its joints where all of its numbers hold
    pose_form   a draft as points and links in one pose, which no chain of dyads can say, and back
    scene_form  a draft as the document of a scene file, and why there is none yet
    building    a draft with what is chosen and typed, the scene made from it, and undo
    gestures    what a hand draws, what is done to the chosen thing, what lies under the pointer
    meanings    what a drag can mean, by what lies at its start and at its end
    dimensions  the numbers of the chosen thing, and digits typed for one of them
    numbers     the numbers of a scene on the sheet that makes it: their things, a scene with others
    storing     a draft as plain data, and back
    tools       the tools of a sheet, as data

The window keeps one `Building`: the `draft`, the `chosen` thing, the digits `typed` for its
number `row`, `past` and `future`, and a `sentence` on what the last gesture did, or why it did nothing. Every
gesture is a pure function that returns another Building; its parameters are names, numbers and texts, as
tapes keep them. A thing is a pair (kind, name): ("joints", "A"), ("bars", "A–B"), ("guides", "1"),
("springs", "s"), ("drive", "input"), ... Points are in the draft's unit of length, y upwards.

By pointer: `reach` is how near counts as on a thing, `snap` the step of places and lengths: 1 or 10 for a
grid, 0.1 with Shift, 0 with Alt. Angles are rounded so that ends move by less than this step.

    click(building, tool, x, y, reach=, snap=)    a ground pin on paper; else chooses what is there
    double_click(building, x, y, reach=, snap=)    a point of the body there
    drag(building, tool, x, y, to_x, to_y, reach=, snap=)    a bar, a guide, a spring, ... as the tool says
    meanings(building, tool, x, y, to_x, to_y, reach=, snap=)    all that it can mean, the likeliest first
    under(draft, x, y, reach)                                what is there: a thing, or None

On the chosen thing:

    choose(building, further)      the next thing, or the one before    choose_thing(building, kind, name)
    move(building, x, y, snap=)    it goes to a point                   delete(building)
    trace(building)                its curve on or off                  drive(building)  it becomes the drive
    write(building, text), erase(building), take(building)              digits for its number `row`, Enter
    choose_number(building, further)                                    the next row of it
    next_option(building)                                               another look, another colour
    undo(building), redo(building)

A photograph behind it: `lay_photo(building, file, x, y, width)`, `move_photo(building, x, y,
to_x, to_y)`, `fit_photo(building, x, y, to_x, to_y, x2, y2, to_x2, to_y2)`, by two known points.

`rows_of(draft, chosen)` are its properties (label, number or words), `row` is the one that is typed.

The result: `building.made.scene` (a Scene, or None) and `building.made.missing` (why there is none).
The scene's document is its file: `scenes.toml.save` writes it. While there is a scene, the window
draws that, and calls `posed(building, phase)` before a gesture, so that places are those of the pose on
the screen. Without a scene it draws `drawn(draft)`. `building_of(scene)` begins
with a scene; `stored(draft)` is the draft as plain data, for JSON, `restored(tables)` a building with it
(`storing.py`).
"""
