"""A scene shows itself in a notebook."""

from __future__ import annotations

from dataclasses import replace

from linkanim.scenes import load


def test_a_notebook_shows_title_source_and_facts() -> None:
    shown = load("double-rocker")._repr_html_()
    for word in ("double-rocker: Grashof double-rocker", "swings", "13.8°…108.4°", "true period"):
        assert word in shown
    assert shown.startswith("<table>")


def test_a_title_is_text_not_markup() -> None:
    shown = replace(load("press"), title="<b>a & b</b>")._repr_html_()
    assert "&lt;b&gt;a &amp; b&lt;/b&gt;" in shown
