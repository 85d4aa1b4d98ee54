"""What was written is read back by decoders that are not ours: Pillow and ffmpeg."""

from __future__ import annotations

import sys
import tracemalloc
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from moving_disc import BACKGROUND, DISC, TURN, TWO_SECONDS, MovingDisc, disc
from numpy.typing import NDArray
from PIL import Image
from reading import Pixels, about, durations, frames_of, loops_for_ever, video

from linkanim.errors import BadInput
from linkanim.recorder import encode
from linkanim.recorder.plan import Clip, Format
from linkanim.recorder.recording import write


def decibels(shown: list[Pixels], drawn: list[Pixels]) -> float:
    errors = [np.mean((a.astype(float) - b) ** 2) for a, b in zip(shown, drawn, strict=True)]
    return float(10 * np.log10(255**2 / max(np.mean(errors), 1e-12)))


def steps(shown: list[Pixels]) -> NDArray[np.float64]:
    """Return how much each frame differs from the one before; the first from the last."""
    return np.array(
        [np.abs(b.astype(float) - a).mean() for a, b in zip([shown[-1], *shown], shown, strict=False)]
    )


@pytest.mark.parametrize("fps", [10, 30])
def test_a_gif_loops_for_ever_and_every_frame_stands_as_long_as_planned(tmp_path: Path, fps: float) -> None:
    frames = disc("gif", TWO_SECONDS._replace(fps=fps))
    write(frames, frames.plan, tmp_path / "disc.gif")
    assert loops_for_ever(tmp_path / "disc.gif")
    times = durations(tmp_path / "disc.gif")
    assert times == [10 * int(100 / frames.plan.rate)] * frames.plan.frames
    assert sum(times) == 2000


def test_a_gif_keeps_frames_that_do_not_differ(tmp_path: Path) -> None:
    frames = disc("gif", Clip(speed=1e-12, period=TURN, seconds=1.0))
    write(frames, frames.plan, tmp_path / "still.gif")
    assert durations(tmp_path / "still.gif") == [40] * 25


def test_a_gif_of_one_frame_is_a_picture(tmp_path: Path) -> None:
    frames = disc("gif", Clip(speed=1.0, period=TURN, seconds=0.04))
    write(frames, frames.plan, tmp_path / "one.gif")
    assert len(frames_of(tmp_path / "one.gif")) == 1


def test_a_gif_shows_what_was_drawn_and_flat_colours_exactly(tmp_path: Path) -> None:
    frames = disc("gif", TWO_SECONDS._replace(seconds=0.6), size=(320, 180))
    write(frames, frames.plan, tmp_path / "disc.gif")
    shown = frames_of(tmp_path / "disc.gif")
    drawn = [frames.rgb(k) for k in range(frames.plan.frames)]
    assert decibels(shown, drawn) >= 50
    for colour in (BACKGROUND, DISC):
        flat = [(rgb == colour).all(axis=2) for rgb in drawn]
        assert all((a[where] == colour).all() for a, where in zip(shown, flat, strict=True))


@pytest.mark.parametrize("form", ["gif", "mp4"])
def test_the_seam_is_a_step_like_the_others(tmp_path: Path, form: Format) -> None:
    frames = disc(form)
    path = tmp_path / f"disc.{form}"
    write(frames, frames.plan, path)
    shown = frames_of(path) if form == "gif" else video(path)
    seam, *others = steps(shown)
    assert 0.5 * min(others) < seam <= 1.25 * max(others)  # zero were a last frame like the first


def test_a_transparent_gif_shows_only_the_disc_in_every_frame(tmp_path: Path) -> None:
    frames = disc("gif", alpha=True)
    write(frames, frames.plan, tmp_path / "disc.gif")
    for k, shown in enumerate(frames_of(tmp_path / "disc.gif", "RGBA")):
        opaque = frames.pixels(k)[..., 3] >= 128
        assert ((shown[..., 3] == 255) == opaque).all()
        assert (shown[frames.pixels(k)[..., 3] == 255][:, :3] == DISC).all()


@pytest.mark.parametrize("alpha", [False, True])
def test_png_frames_are_numbered_from_one_and_exact(tmp_path: Path, alpha: bool) -> None:
    frames = disc("png", alpha=alpha)
    recording = write(frames, frames.plan, tmp_path / "disc.png")
    names = [f"disc-{k:04d}.png" for k in range(1, 51)]
    assert sorted(path.name for path in tmp_path.iterdir()) == [".linkanim-disc.png.json", *names]
    assert recording.path == tmp_path / "disc-0001.png"
    for k, name in enumerate(names):
        with Image.open(tmp_path / name) as image:
            assert image.mode == ("RGBA" if alpha else "RGB")
            shown = np.asarray(image)
        drawn = frames.pixels(k)
        assert (shown[..., :3] == drawn[..., 2::-1]).all()
        assert not alpha or (shown[..., 3] == drawn[..., 3]).all()


def test_an_mp4_is_tagged_for_slides(tmp_path: Path) -> None:
    frames = disc("mp4")
    write(frames, frames.plan, tmp_path / "disc.mp4")
    message = about(tmp_path / "disc.mp4")
    assert "h264" in message
    assert "yuv420p(tv, bt709, progressive)" in message
    assert "64x48" in message
    assert "25 fps" in message
    assert "Duration: 00:00:02.00" in message


def test_an_mp4_starts_with_its_index(tmp_path: Path) -> None:
    frames = disc("mp4")
    write(frames, frames.plan, tmp_path / "disc.mp4")
    data = (tmp_path / "disc.mp4").read_bytes()
    assert 0 < data.index(b"moov") < data.index(b"mdat")


# (size asked, size that yuv420p can hold)
ODD = [((64, 48), (64, 48)), ((63, 48), (64, 48)), ((64, 47), (64, 48)), ((75, 41), (76, 42))]


@pytest.mark.parametrize(("size", "padded"), ODD)
def test_odd_mp4_sizes_are_padded_with_the_edge_and_never_scaled(
    tmp_path: Path, size: tuple[int, int], padded: tuple[int, int]
) -> None:
    frames = disc("mp4", size=size)
    write(frames, frames.plan, tmp_path / "disc.mp4")
    shown = video(tmp_path / "disc.mp4")
    assert shown[0].shape[1::-1] == padded
    assert len(shown) == frames.plan.frames
    kept = [rgb[: size[1], : size[0]] for rgb in shown]
    assert decibels(kept, [frames.rgb(k) for k in range(len(shown))]) > 30  # scaled, it were 20
    for rgb in shown:
        assert np.abs(rgb[-1].astype(int) - BACKGROUND).max() <= 30
        assert (
            np.abs(rgb[:, -1].astype(int) - BACKGROUND).max() <= 30
        )  # ripples of compression; black were 250 off


def test_an_mp4_keeps_colours(tmp_path: Path) -> None:
    frames = disc("mp4", TWO_SECONDS._replace(seconds=0.6), size=(320, 180))
    write(frames, frames.plan, tmp_path / "disc.mp4")
    for k, shown in enumerate(video(tmp_path / "disc.mp4")):
        flat = (frames.rgb(k) == DISC).all(axis=2)
        assert np.abs(np.median(shown[flat], axis=0) - DISC).max() <= 4  # untagged: 18 off


@pytest.mark.parametrize("form", ["gif", "mp4", "png"])
def test_the_same_frames_give_the_same_bytes(tmp_path: Path, form: Format) -> None:
    frames = disc(form)
    for name in ("one", "two"):
        write(frames, frames.plan, tmp_path / f"{name}.{form}")
    one, two = (sorted(tmp_path.glob(f"{name}*")) for name in ("one", "two"))
    assert len(one) == len(two) > 0
    assert [path.read_bytes() for path in one] == [path.read_bytes() for path in two]


@pytest.mark.parametrize("form", ["gif", "mp4", "png"])
def test_a_path_is_only_a_path(tmp_path: Path, form: Format) -> None:
    folder = tmp_path / "50%d %% a:b 'c'"
    folder.mkdir()
    frames = disc(form)
    recording = write(frames, frames.plan, folder / f"-%03d: x.{form}")
    assert recording.path.stat().st_size > 0
    assert [path.name for path in tmp_path.iterdir()] == [folder.name]


@pytest.mark.long
@pytest.mark.slow
def test_memory_does_not_grow_with_the_number_of_frames(tmp_path: Path) -> None:
    def peak(periods: int) -> int:
        frames = disc("gif", TWO_SECONDS._replace(periods=periods, fps=10))
        tracemalloc.start()
        write(frames, frames.plan, tmp_path / "disc.gif")
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return most

    peak(1)
    assert peak(6) <= 1.1 * peak(1)


def test_progress_counts_up_to_all_frames(tmp_path: Path) -> None:
    frames = disc("gif")
    seen: list[tuple[int, int]] = []
    write(frames, frames.plan, tmp_path / "disc.gif", lambda done, total: seen.append((done, total)))
    assert seen == [(k, 50) for k in range(1, 51)]


def test_the_recording_says_what_it_holds(tmp_path: Path) -> None:
    frames = disc("gif")
    recording = write(frames, frames.plan, tmp_path / "disc.gif")
    assert recording.file_bytes == (tmp_path / "disc.gif").stat().st_size
    assert (recording.frames, recording.seconds, recording.size) == (50, 2.0, (64, 48))
    assert recording.summary.startswith(
        f"{tmp_path / 'disc.gif'}: 50 frames at 25 fps, 2 s, one period at 30 rpm"
    )


def test_transparency_in_an_mp4_is_refused_before_any_frame_is_drawn(tmp_path: Path) -> None:
    def no_draw(frame: int) -> None:
        raise AssertionError(frame)

    frames = MovingDisc(disc("mp4").plan, alpha=True, on_draw=no_draw)
    with pytest.raises(BadInput, match="transparency"):
        write(frames, frames.plan, tmp_path / "disc.mp4")
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize(("size", "ahead"), [((1920, 1200), 20), ((2560, 1440), 2)])
def test_few_large_frames_are_on_their_way(
    size: tuple[int, int], ahead: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = list[tuple[str, int, bool]]()

    @contextmanager
    def running(
        command: Sequence[str], *, ahead: int, settings: Mapping[str, str] | None = None
    ) -> Iterator[object]:
        asked.append((" ".join(command), ahead, bool(settings)))
        yield None

    monkeypatch.setattr(encode, "running", running)
    with encode.Stream("mp4", size, Fraction(25)).encoding(Path("a.mp4")):
        pass
    [(command, taken, gives_back)] = asked
    assert (taken, "-tune zerolatency" in command, gives_back) == (ahead, ahead < 20, ahead < 20)


def test_an_encoder_s_settings_are_added_to_its_environment() -> None:
    order = "import os, sys; sys.exit(os.environ.get('KEPT_FRAMES') != '1' or not os.environ.get('PATH'))"
    with encode.running([sys.executable, "-P", "-c", order], ahead=1, settings={"KEPT_FRAMES": "1"}):
        pass
