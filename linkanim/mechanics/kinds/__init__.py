"""The kinds of joints, one file each; this table is the only list of them."""

from linkanim.mechanics.rail import Line

from .crank import Crank, Gear
from .driven_slider import DrivenSlider
from .pin import Pin, Polar
from .rigid import Brace, Rigid, brace
from .rpp import RPP
from .rpr import RPR
from .rrp import RRP
from .rrr import RRR

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
