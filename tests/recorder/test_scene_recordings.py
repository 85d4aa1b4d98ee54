"""Scenes and tapes as recordings: whole periods, without a seam, showing what was asked."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from reading import Pixels, about, durations, frames_of, loops_for_ever, video
from shown_lists import values_in

from linkanim.bench.command import CHART
from linkanim.cli import main
from linkanim.errors import BadInput, RecordingFailed
from linkanim.manifest import single
from linkanim.picture.figure import figure
from linkanim.picture.gears import teeth_a_second
from linkanim.picture.layout import Docked
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen, pixel_view
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.theme import theme_of
from linkanim.player import tape_file
from linkanim.player.action import Action
from linkanim.player.state import begin
from linkanim.player.tape import Tape
from linkanim.recorder import gallery, recording, tape_frames
from linkanim.recorder.gallery import make_gallery, reduced
from linkanim.recorder.plan import Clip, make_plan
from linkanim.recorder.recording import SceneFrames, record
from linkanim.recorder.tape_frames import TapeFrames, record_tape
from linkanim.scenes import load, names
from linkanim.ui.panels import Panels
from linkanim.ui.pictures import recorded

SIZE = (96, 54)
BARE = Look(hud=False, trace=False)


# of every chapter some, with true periods of several turns; that each scene's period closes, mechanics holds
@pytest.mark.parametrize("name", [*names()[::20], "kite", "press", "geared-five-bar-3-2"])
def test_a_scene_loops_over_its_true_period_without_a_seam(tmp_path: Path, name: str) -> None:
    scene = load(name)
    made = record(scene, tmp_path / "out.gif", size=SIZE, fps=10, look=BARE)
    assert loops_for_ever(made.path)
    assert sum(durations(made.path)) == pytest.approx(
        1000 * scene.period / abs(scene.linkage.drive.speed), abs=25
    )
    pictures = [picture.astype(float) for picture in frames_of(made.path)]
    seam, *steps = (np.abs(b - a).mean() for a, b in zip([pictures[-1], *pictures], pictures, strict=False))
    assert 0 < seam <= 1.2 * max(steps)


@pytest.mark.long
def test_a_construction_shows_a_step_a_second_over_one_pose(tmp_path: Path) -> None:
    look = replace(BARE, theme="dark")
    made = record(
        load("crank-rocker"),
        tmp_path / "out.gif",
        size=SIZE,
        fps=4,
        look=look,
        construction="centres",
        start=0.9,
    )
    assert made.plan.summary.endswith(", 7 s, 5 steps of a second")
    pictures = frames_of(made.path)
    assert len(pictures) == made.frames == 28
    changes = [n for n, (a, b) in enumerate(pairwise(pictures), start=1) if (a != b).any()]
    assert changes == [4, 8, 12, 16]  # the last one stands longer
    first = record(
        load("crank-rocker"), tmp_path / "one.gif", size=SIZE, fps=4, construction="dead-centres", steps=1
    )
    assert first.seconds == 3


def test_a_motion_s_options_are_refused_for_a_construction(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = ["record", "crank-rocker", "--construction", "centres", "-o", str(tmp_path / "out.gif")]
    for option in (["--periods", "2"], ["--seconds", "3"], ["--reverse"]):
        assert main([*line, *option]) == 2
        assert f"{option[0]} is for a motion; a construction takes a second" in capsys.readouterr().err
    assert not [*tmp_path.iterdir()]


@pytest.mark.slow
def test_a_scene_with_a_true_period_of_two_turns_is_recorded_for_two(tmp_path: Path) -> None:
    scene = load("kite")
    made = record(scene, tmp_path / "kite.gif", size=SIZE, fps=10)
    assert made.seconds == pytest.approx(2 * 2 * math.pi / abs(scene.linkage.drive.speed), abs=0.05)


@pytest.mark.slow
def test_reverse_shows_the_same_pictures_backwards(tmp_path: Path) -> None:
    for name, back in (("forth", False), ("back", True)):
        record(load("crank-rocker"), tmp_path / f"{name}.png", size=SIZE, fps=10, look=BARE, reverse=back)
    forth, back_again = (
        [frames_of(path)[0].astype(int) for path in sorted(tmp_path.glob(f"{name}-*"))]
        for name in ("forth", "back")
    )
    expected = [forth[0], *reversed(forth[1:])]
    assert all(np.abs(a - b).max() <= 1 for a, b in zip(expected, back_again, strict=True))


def test_a_recording_warns_of_no_limit_unless_it_is_asked_to() -> None:
    scene, size = load("double-rocker"), (640, 360)
    plan = make_plan(Clip(scene.linkage.drive.speed, scene.period), "gif")
    plain, noted = (SceneFrames(scene, plan, size, Look(), noted=noted).draw(0) for noted in (False, True))
    assert plain != noted
    surface = offscreen(size)
    SurfacePrinter().paint(surface, Picture(scene, size, Look()), scene.pose(plan.phase(0), speed=plan.speed))
    assert plain == bytes(pixel_view(surface)) == SceneFrames(scene, plan, size, Look()).draw(0)


def test_two_periods_show_one_twice(tmp_path: Path) -> None:
    record(load("slider-crank"), tmp_path / "two.png", size=SIZE, fps=10, periods=2, look=BARE)
    frames = [path.read_bytes() for path in sorted(tmp_path.glob("two-*.png"))]
    half = len(frames) // 2
    assert frames[:half] == frames[half:]
    assert len(set(frames[:half])) == half


@pytest.mark.slow
def test_the_speed_asked_for_is_recorded_and_said_where_it_is_not(tmp_path: Path) -> None:
    exact = record(load("press"), tmp_path / "a.gif", size=SIZE, fps=10, speed=math.tau / 2)
    assert exact.seconds == 2.0
    assert exact.speed == pytest.approx(math.tau / 2, rel=1e-15)
    moved = record(load("press"), tmp_path / "b.gif", size=SIZE, fps=10, speed=math.tau / 2.04)
    assert "29.41 rpm asked, 30 rpm recorded" in moved.summary


@pytest.mark.parametrize(("size", "form"), [((97, 55), "gif"), ((97, 55), "png"), ((64, 36), "gif")])
def test_gif_and_png_are_exactly_as_large_as_asked(tmp_path: Path, size: tuple[int, int], form: str) -> None:
    made = record(load("parallelogram"), tmp_path / f"out.{form}", size=size, seconds=0.2)
    with Image.open(made.path) as image:
        assert image.size == size


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_flat_colours_of_the_theme_come_out_exactly(tmp_path: Path, theme: str) -> None:
    look = Look(theme="dark" if theme == "dark" else "light")
    made = record(load("crank-rocker"), tmp_path / "out.gif", size=(320, 180), seconds=0.4, look=look)
    for picture in frames_of(made.path):
        assert tuple(picture[0, -1]) == theme_of(theme).background
        assert (picture == theme_of(theme).bodies[0]).all(axis=2).sum() > 20


@pytest.mark.parametrize("form", ["gif", "png"])
def test_a_transparent_recording_has_no_background(tmp_path: Path, form: str) -> None:
    look = Look(background=False)
    record(load("crank-rocker"), tmp_path / f"out.{form}", size=(192, 108), seconds=0.4, look=look)
    pictures = [shot for path in sorted(tmp_path.glob(f"out*.{form}")) for shot in frames_of(path, "RGBA")]
    assert len(pictures) == 10
    for picture in pictures:
        assert not picture[[0, -1], -1, 3].any()
        assert (picture[..., 3] > 128).sum() > 100


# how far a frame laid on a ground may be from the same frame as PNG: at most, and on the mean of its rims
ALPHA = {"webp": (0.0, 0.0), "apng": (0.0, 0.0), "mov": (4.0, 1.0), "webm": (130.0, 2.5)}


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory) -> list[Pixels]:
    """A crank-rocker without its background, as numbered PNG."""
    folder = tmp_path_factory.mktemp("bare")
    record(
        load("crank-rocker"), folder / "out.png", size=(321, 181), seconds=0.4, look=Look(background=False)
    )
    return [frames_of(path, "RGBA")[0] for path in sorted(folder.glob("*.png"))]


@pytest.mark.parametrize("form", ALPHA)
def test_without_its_background_a_recording_has_no_fringe_on_any_ground(
    tmp_path: Path, bare: list[Pixels], form: str
) -> None:
    path = tmp_path / f"out.{form}"
    record(load("crank-rocker"), path, size=(321, 181), seconds=0.4, look=Look(background=False))
    pictures = (frames_of if form == "webp" else video)(path, "RGBA")  # Pillow lays some of APNG's wrongly
    assert len(pictures) == len(bare) == 10
    most, mean = ALPHA[form]
    for picture, wanted in zip(pictures, bare, strict=True):
        rims = (wanted[..., 3] > 0) & (wanted[..., 3] < 255)
        for ground in ((255, 255, 255), (0, 0, 0), (0, 0, 200)):
            off = laid_on(picture, ground) - laid_on(wanted, ground)
            assert abs(off).max() <= most
            assert (abs(off[rims].mean(axis=0)) <= mean).all()


def laid_on(picture: Pixels, ground: tuple[int, int, int]) -> NDArray[np.float64]:
    share = picture[..., 3:] / 255.0
    return np.asarray(picture[..., :3] * share + np.array(ground) * (1.0 - share), np.float64)


@pytest.mark.parametrize("form", ["webp", "apng", "webm", "mov"])
def test_with_its_background_a_recording_is_opaque_and_as_long_as_its_period(
    tmp_path: Path, form: str
) -> None:
    made = record(load("crank-rocker"), tmp_path / f"out.{form}", size=(96, 54), fps=7)
    assert made.frames == 21
    assert made.seconds == 3.0
    if form in ("webp", "apng"):
        assert loops_for_ever(made.path)
        assert all((picture[..., 3] == 255).all() for picture in frames_of(made.path, "RGBA"))
    else:
        assert len(video(made.path)) == 21
        assert "bt709" in about(made.path)
        assert "Duration: 00:00:03.00" in about(made.path)


# why, what is asked beside scene and path
REFUSED = [
    ("no such quantity", {"look": Look(chart="rocker.colour")}),
    ("too small", {"size": (4, 4)}),
    ("no speed", {"speed": 0.0}),
    ("no length", {"seconds": -1.0}),
]


@pytest.mark.parametrize(("why", "options"), REFUSED)
def test_what_cannot_be_recorded_is_refused_and_nothing_is_written(
    tmp_path: Path, why: str, options: dict[str, object]
) -> None:
    with pytest.raises(BadInput):
        record(load("crank-rocker"), tmp_path / "out.gif", **options)  # type: ignore[arg-type]
    assert not any(tmp_path.iterdir())


def test_a_size_is_refused_before_anything_is_made_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recording, "SceneFrames", lambda *_, **__: pytest.fail("it is drawn"))
    with pytest.raises(BadInput, match="100000x100000"):
        record(load("crank-rocker"), tmp_path / "out.gif", size=(100_000, 100_000))


def tape(*actions: tuple[int, Action], frames: int = 60, name: str = "crank-rocker") -> Tape:
    return Tape(begin(load(name)), frames, actions)


def kept(tape: Tape, folder: Path) -> Path:
    path = folder / "made.tape.json"
    tape_file.write(tape, path)
    return path


def test_a_tape_is_refused_at_a_size_that_no_picture_has(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="-5x90 cannot be drawn"):
        record_tape(kept(tape((3, Action("theme"))), tmp_path), tmp_path / "tape.gif", size=(-5, 90))


@pytest.mark.slow
def test_a_tape_in_which_nothing_is_done_is_the_scenes_loop(tmp_path: Path) -> None:
    made = record_tape(kept(tape(frames=7), tmp_path), tmp_path / "tape.gif", size=SIZE, fps=10)
    record(load("crank-rocker"), tmp_path / "scene.gif", size=SIZE, fps=10)
    assert made.plan.closes
    assert (tmp_path / "tape.gif").read_bytes() == (tmp_path / "scene.gif").read_bytes()


@pytest.mark.slow
def test_a_loop_starts_where_its_tape_does(tmp_path: Path) -> None:
    still = tape()
    later = replace(still, start=replace(still.start, clock=still.start.clock.go(0, 1.5)))
    made = record_tape(kept(later, tmp_path), tmp_path / "tape.gif", size=SIZE, fps=10)
    assert made.plan.phase(0) == 1.5
    assert made.plan.closes


def test_what_is_done_during_a_tape_shows_in_the_recording(tmp_path: Path) -> None:
    done = tape((12, Action("theme")), (36, Action("mechanism", 1)))
    made = record_tape(kept(done, tmp_path), tmp_path / "tape.gif", size=SIZE, fps=10)
    pictures = frames_of(made.path)
    assert (made.frames, made.seconds) == (10, 1.0)
    dark = [tuple(picture[0, -1]) == theme_of("dark").background for picture in pictures]
    light = [tuple(picture[0, -1]) == theme_of("light").background for picture in pictures]
    assert dark == [False] * 2 + [True] * 8
    assert light == [True] * 2 + [False] * 8
    steps = [np.abs(b.astype(int) - a).mean() for a, b in pairwise(pictures[2:])]
    assert steps.index(max(steps)) == 3  # the next mechanism comes with frame 36, which is picture 6


# At its own speed, not the scene's: HUD, arrows and the loop's length tell it.
def test_a_tape_is_drawn_at_its_own_speed(tmp_path: Path) -> None:
    done, size = tape((1, Action("speed", 4)), (2, Action("vectors", "v")), frames=60), (480, 270)
    state, phase = list(done.pictures(10))[5]
    scene, speed = state.scene, state.clock.speed
    assert abs(speed) > 1.2 * abs(scene.linkage.drive.speed)

    def drawn(speed: float) -> bytes:
        plan = make_plan(Clip(speed, scene.period, seconds=1.0, start=phase), "png")
        return bytes(SceneFrames(scene, plan, size, state.look).draw(0))

    picture = bytes(TapeFrames(done, 10, size).draw(5))
    assert picture == drawn(speed)
    assert picture != drawn(scene.linkage.drive.speed)


# A loop's length follows from it; of what was done it is what is told of the recording.
@pytest.mark.parametrize("done", [(), ((1, Action("theme")),)], ids=["a loop", "something done"])
def test_a_recording_is_told_at_its_tapes_speed(done: tuple[tuple[int, Action], ...], tmp_path: Path) -> None:
    still = tape(*done)
    faster = replace(still, start=replace(still.start, clock=replace(still.start.clock, level=4)))
    made = record_tape(kept(faster, tmp_path), tmp_path / "tape.mp4", size=SIZE, fps=10)
    assert made.speed == pytest.approx(faster.start.clock.speed)
    assert abs(made.speed) > 1.2 * abs(still.start.clock.speed)


def test_a_recording_shows_the_open_list_and_the_scene_beside_it() -> None:
    done, size = tape((2, Action("chart", 1)), (4, Action("edit")), frames=60), (480, 270)
    state, phase = list(done.pictures(10))[9]
    wanted = offscreen(size)
    picture = Picture(state.scene, size, state.look, docked=Docked(listed=1), noted=True)
    assert values_in(state) is not None
    SurfacePrinter().print(wanted, picture, phase, state.clock.speed, recorded(state))
    (sheet,), _ = Panels().drawn(state, picture.layout, picture.theme, shown="tape")
    wanted.blit(sheet.surface, sheet.at)
    drawn = TapeFrames(done, 10, size).draw(9), pixel_view(wanted)
    frames = [np.frombuffer(one, np.uint8) for one in drawn]
    found, seen = (frame.reshape(-1, 4)[:, :3] for frame in frames)  # the fourth byte has no meaning
    assert (found == seen).all()


# The window's shape, 1280 along the longer side, even for the encoder.
@pytest.mark.parametrize(
    ("window", "size"), [((1280, 720), (1280, 720)), ((640, 480), (1280, 960)), ((599, 900), (852, 1280))]
)
def test_a_recording_has_its_windows_shape(window: tuple[int, int], size: tuple[int, int]) -> None:
    assert tape_frames._shape(window) == size


@pytest.mark.slow
def test_a_tapes_pictures_do_not_depend_on_the_order_in_which_they_are_drawn() -> None:
    done = tape((20, Action("direction")), (30, Action("speed", 3)), (38, Action("closure")))
    anew = [bytes(TapeFrames(done, 10, SIZE).draw(k)) for k in range(10)]
    one = TapeFrames(done, 10, SIZE)
    assert [bytes(one.draw(k)) for k in (0, 3, 7, 7, 2, 9)] == [anew[k] for k in (0, 3, 7, 7, 2, 9)]


@pytest.mark.slow
def test_the_gallery_is_small_whole_and_the_same_every_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gallery, "SIZE", (192, 108))
    monkeypatch.setattr(gallery, "RATES", (5.0,))
    chosen = ("crank-rocker", "slider-crank")
    one, two = (make_gallery(tmp_path / name, chosen) for name in ("one", "two"))
    files = {path.name: path.read_bytes() for path in (tmp_path / "one").iterdir()}
    assert set(files) == {"crank-rocker.gif", "slider-crank.gif", gallery.SHEET, ".linkanim-gallery.json"}
    assert files == {path.name: path.read_bytes() for path in (tmp_path / "two").iterdir()}
    assert [made.path.name for made in one[0]] == ["crank-rocker.gif", "slider-crank.gif"]
    assert {made.size for made in one[0]} == {(192, 108)}
    assert two[1] == tmp_path / "two" / gallery.SHEET
    with Image.open(one[1]) as sheet:
        assert sheet.size == (4 * 198 + 6, 114 + 6)
        assert sheet.mode == "P"


def test_the_sheet_keeps_flat_areas_as_they_are_and_the_rest_near() -> None:
    shades = np.arange(3 * 60 * 80, dtype=np.uint8).reshape(60, 80, 3)
    picture = np.concatenate([np.full((60, 80, 3), 206, np.uint8), np.full_like(shades, 40), shades])
    found = reduced(picture)
    assert len(np.unique(found.reshape(-1, 3), axis=0)) <= 160
    assert (found[:120] == picture[:120]).all()
    assert np.abs(found[120:].astype(int) - shades).mean() < 8


@pytest.mark.long
@pytest.mark.slow
def test_a_gallery_recording_that_is_too_large_gets_fewer_frames(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gallery, "SIZE", SIZE)
    (largest,), _ = make_gallery(tmp_path, ["crank-rocker"])
    monkeypatch.setattr(gallery, "LARGEST", largest.file_bytes - 1)
    (smaller,), _ = make_gallery(tmp_path, ["crank-rocker"])
    assert (largest.frames, smaller.frames) == (60, 50)
    assert smaller.file_bytes < largest.file_bytes


@pytest.mark.long
@pytest.mark.slow
def test_a_gallery_recording_that_is_too_large_at_any_rate_is_smaller(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gallery, "SIZE", (160, 90))
    monkeypatch.setattr(gallery, "RATES", (5.0,))
    monkeypatch.setattr(gallery, "LARGEST", 0)
    (large,), _ = make_gallery(tmp_path, ["kite"])
    monkeypatch.setattr(gallery, "MOST", large.file_bytes - 1)
    (smaller,), _ = make_gallery(tmp_path, ["kite"])
    assert smaller.frames == large.frames
    with Image.open(smaller.path) as image:
        assert image.size == (128, 72)
    monkeypatch.setattr(gallery, "MOST", 0)
    (smallest,) = make_gallery(tmp_path, ["kite"])[0]
    assert smallest.size == (80, 45)  # half as wide: the last share


def test_the_gallery_shows_no_wheel_turning_backwards() -> None:
    """Between two frames a tooth moves less than a third of its pitch, so that the eye follows it."""
    for name in names():
        scene = load(name)
        teeth = teeth_a_second(figure(scene))
        chosen = gallery.rates(scene)
        assert all(teeth / fps < 1 / 3 for fps in chosen), name
    assert teeth_a_second(figure(load("geared-five-bar-2-1"))) == pytest.approx(8.0)
    assert gallery.rates(load("geared-five-bar-2-1")) == (gallery.FASTEST,)
    assert gallery.rates(load("cardan-gears")) == gallery.RATES[:2]
    assert gallery.rates(load("kite")) == gallery.RATES


@pytest.mark.slow
def test_the_gallery_takes_a_tape_where_there_is_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gallery, "SIZE", SIZE)
    tape_file.write(tape((3, Action("theme")), frames=30, name="press"), tmp_path / "press.tape.json")
    (made,) = make_gallery(tmp_path, ["press"])[0]
    assert made.seconds == pytest.approx(0.5, abs=0.05)


@pytest.mark.parametrize("name", ["kite.gif", "press.gif", gallery.SHEET])
def test_a_gallery_leaves_files_that_are_not_its_own_and_draws_nothing_then(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / name).write_bytes(b"mine")
    monkeypatch.setattr(gallery, "load", pytest.fail)
    with pytest.raises(BadInput, match=f"{name} may not be linkanim.s own .*move it away"):
        make_gallery(tmp_path, ["kite", "press"])
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [(name, b"mine")]


@pytest.mark.long
@pytest.mark.slow
def test_a_gallery_that_fails_on_the_way_keeps_what_it_finished_and_goes_on_the_next_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gallery, "SIZE", SIZE)
    monkeypatch.setattr(gallery, "RATES", (5.0,))
    make_gallery(tmp_path, ["crank-rocker", "slider-crank"])
    slider = (tmp_path / "slider-crank.gif").read_bytes()
    monkeypatch.setattr(gallery, "SIZE", (80, 45))
    with monkeypatch.context() as meanwhile:
        meanwhile.setattr(
            gallery, "rates", lambda scene: (10.0,) if scene.name != "slider-crank" else (1e-9,)
        )
        with pytest.raises(BadInput):
            make_gallery(tmp_path, ["crank-rocker", "slider-crank"])
    with Image.open(tmp_path / "crank-rocker.gif") as image:
        assert image.size == (80, 45)
    assert (tmp_path / "slider-crank.gif").read_bytes() == slider
    assert make_gallery(tmp_path, ["crank-rocker", "slider-crank"])[0][1].size == (80, 45)


def test_a_gallery_s_failure_is_named_by_the_file_that_was_to_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stopped(*_: object) -> int:
        return 0

    monkeypatch.setattr(gallery, "SIZE", SIZE)
    monkeypatch.setattr("linkanim.recorder.recording.count_frames", stopped)
    with pytest.raises(RecordingFailed, match=rf"^{re.escape(str(tmp_path / 'kite.gif'))} was not recorded"):
        make_gallery(tmp_path, ["kite"])
    assert list(tmp_path.iterdir()) == []


def test_the_repository_s_gallery_is_known_as_ours() -> None:
    """So that `linkanim gallery` in a checkout may make it anew: its list goes with it."""
    recordings = Path(__file__).parents[2] / "recordings"
    made = [*(f"{name}.gif" for name in names()), gallery.SHEET]
    gallery.gallery_files(recordings).refuse_foreign(made)
    assert set(gallery.gallery_files(recordings).sums()) == set(made)
    single(recordings / CHART).refuse_foreign([CHART])


def test_a_gallery_in_a_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(BadInput, match="is a file"):
        make_gallery(tmp_path / "file", ["press"])


# what a notebook finds in the page
@pytest.mark.parametrize(("form", "tag"), [("gif", "<img src"), ("mp4", "<video src"), ("png", None)])
def test_a_notebook_shows_a_recording(tmp_path: Path, form: str, tag: str | None) -> None:
    made = record(load("kite"), tmp_path / f"kite.{form}", size=SIZE, seconds=0.2)
    page, picture = made._repr_html_(), made._repr_png_()
    assert page is None if tag is None else (page or "").startswith(tag)
    assert page is None or f'width="{SIZE[0]}"' in page
    assert (picture == made.path.read_bytes()) == (form == "png")
