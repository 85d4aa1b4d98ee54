"""Actions that put another scene on: of the shelf, or the other closure; the open list of quantities."""

from __future__ import annotations

from dataclasses import replace

from linkanim.errors import LinkanimError
from linkanim.mechanics.facts.classify import Info
from linkanim.player.state import editing as edit
from linkanim.player.state.browsing import Browsing, FileNames, Listing, listed
from linkanim.player.state.editing import Editing
from linkanim.player.state.fault import proved
from linkanim.player.state.glide import glide
from linkanim.player.state.state import Edited, State, fresh, with_toast
from linkanim.scenes import chapter_of, chapters, load
from linkanim.scenes.editing.closures import other_closure
from linkanim.scenes.scene import Scene

_LONGEST = 40


def mechanism(state: State, further: int) -> State:
    """Put on the scene so many places further on the shelf."""
    return put_on(state, (state.place + further) % len(state.shelf))


def select(state: State, place: int) -> State:
    """Choose within the chapter of the scene that is on; beside the catalogue, within its first."""
    all_, chapter = chapters(), chapter_of(state.scene.name)
    members = all_[chapter] if chapter else next(iter(all_.values()))
    if place >= len(members) or members[place] not in state.shelf:
        return state
    return put_on(state, state.shelf.index(members[place]))


def closure(state: State, _: None) -> State:
    """Exchange the scene for its other closure; undo goes back."""
    try:
        scene = other_closure(state.scene)
    except LinkanimError as error:
        return with_toast(state, str(error))
    return exchanged(replace(state, editing=edit.changed(state.editing, state.scene)), scene)


def renewed(state: State, scene: Scene) -> State:
    """Put on the scene of one's own as its file has it now; where it is on already, undo goes back."""
    catalogue = tuple(entry for entry in state.shelf if isinstance(entry, str))
    own = len(state.shelf) - len(catalogue)
    was_on, by = state.place < own, 1 - own
    state = replace(state, shelf=(scene, *catalogue))
    if not was_on:
        # the catalogue's places are behind the one of the scene of one's own, which begins anew
        kept = tuple(one._replace(place=one.place + by) for one in state.kept if one.place >= own)
        return put_on(replace(state, place=state.place + by, kept=kept), 0)
    editing = replace(edit.changed(state.editing, state.scene), original=scene)
    return exchanged(replace(state, held=None, glide=None, sketch=None, editing=editing), scene)


def exchanged(state: State, scene: Scene) -> State:
    """Show a changed scene at the phase the old one stands at; whatever its solver raises."""
    clock = state.clock.at_rate(state.frame, scene.linkage.drive.speed)
    proved(scene, clock.at(state.frame))
    look = replace(state.look, chart=_kept_chart(state, scene))
    turned = state.turned if _verdict(scene.info) == _verdict(state.scene.info) else state.frame
    return replace(state, scene=scene, clock=clock, look=look, turned=turned)


def followed(state: State, scene: Scene) -> State:
    """Show a changed scene, the one that is shown gliding to it."""
    way = glide(state.shown, scene, state.frame)
    return replace(exchanged(state, scene), glide=way)


def _verdict(info: Info) -> tuple[str, bool, bool]:
    """Return the class, and on which side of Grashof's rule the lengths are."""
    rule = info.grashof or ""
    return info.class_name, "<" in rule, ">" in rule


def put_on(state: State, place: int) -> State:
    """Start a mechanism of the shelf as it was left, else as its file says, paused where the last one was."""
    entry, kept = state.shelf[place], _kept_edits(state)
    was = next((one for one in kept if one.place == place), None)
    scene = proved(was.scene if was else load(entry) if isinstance(entry, str) else entry, 0.0)
    clock = fresh(scene).go(state.frame, 0.0, paused=state.clock.paused)
    look = replace(state.look, zoom=1.0, pan=(0.0, 0.0), chart=_kept_chart(state, scene))
    bare = replace(state, listing=None, held=None, sketch=None, glide=None, turned=None, faded=state.frame)
    bare = replace(bare, arrived=state.frame)
    editing = replace(was.editing if was else Editing(), open=state.editing.open)
    others = tuple(one for one in kept if one is not was)
    return replace(bare, editing=editing, kept=others, scene=scene, place=place, clock=clock, look=look)


def _kept_edits(state: State) -> tuple[Edited, ...]:
    """Return what is kept of all places, that of the one that is on with its values begun let go."""
    own = replace(state.editing, open=False, typed="", drafts=(), refusal=None, warned=False)
    return (*state.kept, *([Edited(state.place, state.scene, own)] if own.changed else []))


def _kept_chart(state: State, scene: Scene) -> str | None:
    chart = state.look.chart
    return chart if chart and chart in scene.quantities else None


def list_(state: State, _: None) -> State:
    """Open the list of quantities, at the one that is charted, or close it."""
    if state.listing:
        return replace(state, listing=None)
    tokens = listed(state.scene, "")
    at = tokens.index(state.look.chart) if state.look.chart in tokens else 0
    return replace(state, listing=Listing(at), browsing=None)


def open_shelf(state: State, _: None) -> State:
    """Open the shelf, or close it."""
    if state.browsing:
        return replace(state, browsing=None)
    return replace(state, listing=None, browsing=Browsing(state.shelf, state.place, state.frame))


def move(state: State, further: int) -> State:
    """Choose so many further of what is found; the list has ends, the shelf goes round."""
    if state.browsing:
        found = state.browsing.found
        if state.browsing.chosen not in found:
            return state
        chosen = found[(found.index(state.browsing.chosen) + further) % len(found)]
        return replace(state, browsing=replace(state.browsing, chosen=chosen))
    if state.listing is None:
        return state
    last = max(len(state.listing.found(state.scene)) - 1, 0)
    chosen = min(max(state.listing.chosen + further, 0), last)
    return replace(state, listing=replace(state.listing, chosen=chosen))


def point(state: State, place: int) -> State:
    """Choose a place on the shelf."""
    if state.browsing is None or place not in state.browsing.found:
        return state
    return replace(state, browsing=replace(state.browsing, chosen=place))


def top(state: State, row: int) -> State:
    """Scroll the shelf to a row."""
    return replace(state, browsing=state.browsing and replace(state.browsing, top=row))


def sift(state: State, text: str) -> State:
    """Add letters to the sieve of the list, and go to its top, or to that of the shelf."""
    if state.browsing:
        longer = (state.browsing.sieve + text)[:_LONGEST]
        return replace(state, browsing=state.browsing.sifted(longer))
    return _relisted(state, state.listing.sieve + text) if state.listing else state


def unsift(state: State, _: None) -> State:
    """Take the last letter off the sieve of the list, and go to its top, or off that of the shelf."""
    if state.browsing:
        return replace(state, browsing=state.browsing.sifted(state.browsing.sieve[:-1]))
    return _relisted(state, state.listing.sieve[:-1]) if state.listing else state


def _relisted(state: State, sieve: str) -> State:
    assert state.listing
    return replace(state, listing=state.listing.sifted(sieve[:_LONGEST]))


def files(state: State, names: str) -> State:
    """Open the list of files, one name a line."""
    return replace(state, listing=Listing(0, files=FileNames(tuple(names.splitlines()))), browsing=None)


def plot(state: State, token: str) -> State:
    """Chart a quantity, and close the list."""
    if token not in state.scene.quantities:
        return with_toast(state, f"{state.scene.name} has no quantity {token}")
    return replace(state, look=replace(state.look, chart=token), listing=None)


def put(state: State, place: int) -> State:
    """Put on a scene by its place on the shelf, and close the shelf."""
    if not 0 <= place < len(state.shelf):
        return state
    return replace(put_on(state, place), browsing=None)
