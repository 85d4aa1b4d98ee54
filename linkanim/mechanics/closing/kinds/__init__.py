"""The kinds of joints, one file each; this table is the only list of them."""

from linkanim.mechanics.closing.kinds.crank import Crank, Gear
from linkanim.mechanics.closing.kinds.driven_slider import DrivenSlider
from linkanim.mechanics.closing.kinds.pin import Pin, Polar
from linkanim.mechanics.closing.kinds.rigid import Brace, Rigid, brace
from linkanim.mechanics.closing.kinds.rpp import RPP
from linkanim.mechanics.closing.kinds.rpr import RPR
from linkanim.mechanics.closing.kinds.rrp import RRP
from linkanim.mechanics.closing.kinds.rrr import RRR
from linkanim.mechanics.linkage.rail import Line

KINDS = (Pin, Crank, DrivenSlider, RRR, RRP, RPR, RPP, Rigid, Brace)
"""Every kind that a linkage can be made of."""

__all__ = [
    "KINDS",
    "RPP",
    "RPR",
    "RRP",
    "RRR",
    "Brace",
    "Crank",
    "DrivenSlider",
    "Gear",
    "Line",
    "Pin",
    "Polar",
    "Rigid",
    "brace",
]
