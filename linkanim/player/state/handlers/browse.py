"""Actions on the list of quantities and on the shelf, and what is picked there."""

from __future__ import annotations

from dataclasses import replace

from linkanim.picture.diagrams.quantities import quantities
from linkanim.player.state.browsing import Browsing, Listing, listed, moved, sifted, unsifted
from linkanim.player.state.handlers.shelf import put_on
from linkanim.player.state.state import State, with_toast


def list_(state: State, _: None) -> State:
    """Open the list of quantities, at the one that is charted, or close it."""
    if state.listing:
        return replace(state, listing=None)
    tokens = listed(state.scene, "")
    at = tokens.index(state.look.chart) if state.look.chart in tokens else 0
    return replace(state, listing=Listing(at), browsing=None)


def shelf(state: State, _: None) -> State:
    """Open the shelf, or close it."""
    if state.browsing:
        return replace(state, browsing=None)
    return replace(state, listing=None, browsing=Browsing(state.shelf, state.place, state.frame))


def move(state: State, further: int) -> State:
    """Choose so many further; the list has ends, the shelf goes round."""
    if state.browsing:
        chosen = (state.browsing.chosen + further) % len(state.browsing.entries)
        return replace(state, browsing=replace(state.browsing, chosen=chosen))
    return replace(state, listing=moved(state.listing, state.scene, further) if state.listing else None)


def point(state: State, place: int) -> State:
    """Choose a place on the shelf."""
    if state.browsing is None or not 0 <= place < len(state.browsing.entries):
        return state
    return replace(state, browsing=replace(state.browsing, chosen=place))


def sift(state: State, text: str) -> State:
    """Add letters to the list's sieve."""
    return replace(state, listing=sifted(state.listing, text) if state.listing else None)


def unsift(state: State, _: None) -> State:
    """Take the last letter off the list's sieve."""
    return replace(state, listing=unsifted(state.listing) if state.listing else None)


def plot(state: State, token: str) -> State:
    """Chart a quantity, and close the list."""
    if token not in quantities(state.scene):
        return with_toast(state, f"{state.scene.name} has no quantity {token}")
    return replace(state, look=replace(state.look, chart=token), listing=None)


def put(state: State, place: int) -> State:
    """Put on a scene by its place on the shelf, and close the shelf."""
    if not 0 <= place < len(state.shelf):
        return state
    return replace(put_on(state, place), browsing=None)
