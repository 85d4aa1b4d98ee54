"""Moving pictures as a file of slides: one a slide, full-bleed or under its title, with notes.

A `.pptx` is a zip of XML parts (ECMA-376). A GIF on a slide starts by itself and loops in every program that
shows one, so that a slide needs neither a timing nor a cover picture.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from io import BytesIO
from typing import NamedTuple
from xml.sax.saxutils import escape, quoteattr
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile, ZipInfo

WIDTH = 12_192_000
"""A slide's width in EMU (914,400 to the inch): 13⅓ inches."""
_TITLE = 0.12
"""The share of a slide's height that its title takes."""
_THEN = (2000, 1, 1, 0, 0, 0)
"""The time of every part: the same slides have the same bytes, whenever they are written."""

_A = "http://schemas.openxmlformats.org/drawingml/2006/main"
_P = "http://schemas.openxmlformats.org/presentationml/2006/main"
_R = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_SPACES = f'xmlns:a="{_A}" xmlns:r="{_R}" xmlns:p="{_P}"'
_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
_TYPE = "application/vnd.openxmlformats-officedocument.presentationml"


class DeckSlide(NamedTuple):
    """A GIF, its size in pixels, the title of its slide, and what is said of it in the notes."""

    gif: bytes
    size: tuple[int, int]
    title: str
    notes: str

    def markup(self, height: int, *, titled: bool) -> str:
        """Return a slide: its title, if it shows one, and its picture, as large as fits below."""
        top = round(_TITLE * height) if titled else 0
        scale = min(WIDTH / self.size[0], (height - top) / self.size[1])
        wide, high = (round(scale * side) for side in self.size)
        at = f'<a:off x="{(WIDTH - wide) // 2}" y="{top + (height - top - high) // 2}"/>'
        title = _text("Title", "title", self.title) if titled else ""
        picture = (
            f'<p:pic><p:nvPicPr><p:cNvPr id="4" name={quoteattr(self.title)} descr={quoteattr(self.notes)}/>'
            '<p:cNvPicPr><a:picLocks noChangeAspect="1"/></p:cNvPicPr><p:nvPr/></p:nvPicPr>'
            '<p:blipFill><a:blip r:embed="rId2"/><a:stretch><a:fillRect/></a:stretch></p:blipFill>'
            f'<p:spPr><a:xfrm>{at}<a:ext cx="{wide}" cy="{high}"/></a:xfrm>'
            '<a:prstGeom prst="rect"><a:avLst/></a:prstGeom></p:spPr></p:pic>'
        )
        tree = _tree(title + picture)
        return f"{_HEAD}<p:sld {_SPACES}><p:cSld>{tree}</p:cSld>{_COLOURS_OF_MASTER}</p:sld>"

    def notes_markup(self) -> str:
        """Return the page of its notes."""
        image = (
            '<p:sp><p:nvSpPr><p:cNvPr id="2" name="Slide"/><p:cNvSpPr><a:spLocks noGrp="1" noRot="1" '
            'noChangeAspect="1"/></p:cNvSpPr><p:nvPr><p:ph type="sldImg"/></p:nvPr></p:nvSpPr>'
            "<p:spPr/></p:sp>"
        )
        body = _text("Notes", 'body" idx="1', self.notes)
        tree = _tree(image + body)
        return f"{_HEAD}<p:notes {_SPACES}><p:cSld>{tree}</p:cSld>{_COLOURS_OF_MASTER}</p:notes>"


def below_title(size: tuple[int, int]) -> tuple[int, int]:
    """Return the size of a picture under the title of a slide that has the shape of `size`; even numbers."""
    return size[0], 2 * round((1.0 - _TITLE) * size[1] / 2)


def deck(slides: Sequence[DeckSlide], shape: tuple[int, int], *, titled: bool = False) -> bytes:
    """Return slides in the shape of `shape` (width, height) as the bytes of a `.pptx`.

    A slide's picture is as large as fits, in the middle; with `titled` below the slide's title.
    """
    height = round(WIDTH * shape[1] / shape[0])
    packed = BytesIO()
    with ZipFile(packed, "w") as file:
        for name, content in _parts(slides, height, titled=titled):
            how = ZIP_STORED if name.endswith(".gif") else ZIP_DEFLATED
            info = ZipInfo(name, _THEN)
            info.compress_type = how
            file.writestr(info, content if isinstance(content, bytes) else content.encode())
    return packed.getvalue()


def _parts(slides: Sequence[DeckSlide], height: int, *, titled: bool) -> Iterator[tuple[str, str | bytes]]:
    """Yield the parts of the file by their names, and those that say how they belong together."""
    numbers = range(1, len(slides) + 1)
    yield "[Content_Types].xml", _content_types(numbers)
    yield "_rels/.rels", _relations({"rId1": ("officeDocument", "ppt/presentation.xml")})
    yield "ppt/presentation.xml", _presentation(numbers, height)
    inside = {
        "rId1": ("slideMaster", "slideMasters/slideMaster1.xml"),
        "rId2": ("notesMaster", "notesMasters/notesMaster1.xml"),
        "rId3": ("theme", "theme/theme1.xml"),
        **{f"rId{3 + n}": ("slide", f"slides/slide{n}.xml") for n in numbers},
    }
    yield "ppt/_rels/presentation.xml.rels", _relations(inside)
    for n in (1, 2):
        yield f"ppt/theme/theme{n}.xml", _THEME
    yield "ppt/slideMasters/slideMaster1.xml", _MASTER.replace("{title}", _title_box(height))
    master = {"rId1": ("slideLayout", "../slideLayouts/slideLayout1.xml")}
    yield (
        "ppt/slideMasters/_rels/slideMaster1.xml.rels",
        _relations({**master, "rId2": ("theme", "../theme/theme1.xml")}),
    )
    yield "ppt/slideLayouts/slideLayout1.xml", _LAYOUT
    above = {"rId1": ("slideMaster", "../slideMasters/slideMaster1.xml")}
    yield "ppt/slideLayouts/_rels/slideLayout1.xml.rels", _relations(above)
    yield "ppt/notesMasters/notesMaster1.xml", _NOTES_MASTER
    yield (
        "ppt/notesMasters/_rels/notesMaster1.xml.rels",
        _relations({"rId1": ("theme", "../theme/theme2.xml")}),
    )
    for n, slide in zip(numbers, slides, strict=True):
        yield f"ppt/media/image{n}.gif", slide.gif
        yield f"ppt/slides/slide{n}.xml", slide.markup(height, titled=titled)
        shown = {
            "rId1": ("slideLayout", "../slideLayouts/slideLayout1.xml"),
            "rId2": ("image", f"../media/image{n}.gif"),
            "rId3": ("notesSlide", f"../notesSlides/notesSlide{n}.xml"),
        }
        yield f"ppt/slides/_rels/slide{n}.xml.rels", _relations(shown)
        yield f"ppt/notesSlides/notesSlide{n}.xml", slide.notes_markup()
        said = {
            "rId1": ("notesMaster", "../notesMasters/notesMaster1.xml"),
            "rId2": ("slide", f"../slides/slide{n}.xml"),
        }
        yield f"ppt/notesSlides/_rels/notesSlide{n}.xml.rels", _relations(said)


def _relations(relations: Mapping[str, tuple[str, str]]) -> str:
    lines = (
        f'<Relationship Id="{key}" Type="{_R}/{kind}" Target="{target}"/>'
        for key, (kind, target) in relations.items()
    )
    return f'{_HEAD}<Relationships xmlns="{_PACKAGE}/relationships">{"".join(lines)}</Relationships>'


def _content_types(numbers: Iterable[int]) -> str:
    kinds = {
        "/ppt/presentation.xml": f"{_TYPE}.presentation.main+xml",
        "/ppt/slideMasters/slideMaster1.xml": f"{_TYPE}.slideMaster+xml",
        "/ppt/slideLayouts/slideLayout1.xml": f"{_TYPE}.slideLayout+xml",
        "/ppt/notesMasters/notesMaster1.xml": f"{_TYPE}.notesMaster+xml",
    }
    for n in (1, 2):
        kinds[f"/ppt/theme/theme{n}.xml"] = "application/vnd.openxmlformats-officedocument.theme+xml"
    for n in numbers:
        kinds[f"/ppt/slides/slide{n}.xml"] = f"{_TYPE}.slide+xml"
        kinds[f"/ppt/notesSlides/notesSlide{n}.xml"] = f"{_TYPE}.notesSlide+xml"
    usual = {
        "rels": "application/vnd.openxmlformats-package.relationships+xml",
        "xml": "application/xml",
        "gif": "image/gif",
    }
    lines = [f'<Default Extension="{end}" ContentType="{kind}"/>' for end, kind in usual.items()]
    lines += [f'<Override PartName="{name}" ContentType="{kind}"/>' for name, kind in kinds.items()]
    return f'{_HEAD}<Types xmlns="{_PACKAGE}/content-types">{"".join(lines)}</Types>'


def _presentation(numbers: Iterable[int], height: int) -> str:
    slides = "".join(f'<p:sldId id="{255 + n}" r:id="rId{3 + n}"/>' for n in numbers)
    return (
        f"{_HEAD}<p:presentation {_SPACES}>"
        '<p:sldMasterIdLst><p:sldMasterId id="2147483648" r:id="rId1"/></p:sldMasterIdLst>'
        '<p:notesMasterIdLst><p:notesMasterId r:id="rId2"/></p:notesMasterIdLst>'
        f"<p:sldIdLst>{slides}</p:sldIdLst>"
        f'<p:sldSz cx="{WIDTH}" cy="{height}"/><p:notesSz cx="6858000" cy="9144000"/></p:presentation>'
    )


def _title_box(height: int) -> str:
    """Return where titles stand."""
    side = round(0.03 * WIDTH)
    return f'<a:off x="{side}" y="0"/><a:ext cx="{WIDTH - 2 * side}" cy="{round(_TITLE * height)}"/>'


def _text(name: str, kind: str, words: str) -> str:
    """Return words in a place of the master's."""
    return (
        f'<p:sp><p:nvSpPr><p:cNvPr id="3" name="{name}"/><p:cNvSpPr><a:spLocks noGrp="1"/></p:cNvSpPr>'
        f'<p:nvPr><p:ph type="{kind}"/></p:nvPr></p:nvSpPr><p:spPr/><p:txBody><a:bodyPr/><a:lstStyle/>'
        f"<a:p><a:r><a:t>{escape(words)}</a:t></a:r></a:p></p:txBody></p:sp>"
    )


def _tree(shapes: str) -> str:
    return (
        '<p:spTree><p:nvGrpSpPr><p:cNvPr id="1" name=""/><p:cNvGrpSpPr/><p:nvPr/></p:nvGrpSpPr>'
        f"<p:grpSpPr/>{shapes}</p:spTree>"
    )


_COLOURS_OF_MASTER = "<p:clrMapOvr><a:masterClrMapping/></p:clrMapOvr>"
_COLOURS = (
    '<p:clrMap bg1="lt1" tx1="dk1" bg2="lt2" tx2="dk2" accent1="accent1" accent2="accent2" '
    'accent3="accent3" accent4="accent4" accent5="accent5" accent6="accent6" hlink="hlink" '
    'folHlink="folHlink"/>'
)
_WHITE = '<p:bg><p:bgPr><a:solidFill><a:srgbClr val="FFFFFF"/></a:solidFill><a:effectLst/></p:bgPr></p:bg>'
_MASTER = (
    f"{_HEAD}<p:sldMaster {_SPACES}><p:cSld>{_WHITE}"
    + _tree(
        '<p:sp><p:nvSpPr><p:cNvPr id="2" name="Title"/><p:cNvSpPr><a:spLocks noGrp="1"/></p:cNvSpPr>'
        '<p:nvPr><p:ph type="title"/></p:nvPr></p:nvSpPr><p:spPr><a:xfrm>{title}</a:xfrm>'
        '<a:prstGeom prst="rect"><a:avLst/></a:prstGeom></p:spPr><p:txBody><a:bodyPr anchor="ctr"/>'
        "<a:lstStyle/><a:p><a:r><a:t>Title</a:t></a:r></a:p></p:txBody></p:sp>"
    )
    + f"</p:cSld>{_COLOURS}"
    '<p:sldLayoutIdLst><p:sldLayoutId id="2147483649" r:id="rId1"/></p:sldLayoutIdLst><p:txStyles>'
    '<p:titleStyle><a:lvl1pPr algn="l"><a:defRPr sz="3200">'
    '<a:solidFill><a:schemeClr val="tx1"/></a:solidFill>'
    '<a:latin typeface="+mj-lt"/></a:defRPr></a:lvl1pPr></p:titleStyle><p:bodyStyle/><p:otherStyle/>'
    "</p:txStyles></p:sldMaster>"
)
_LAYOUT = (
    f'{_HEAD}<p:sldLayout {_SPACES} type="titleOnly"><p:cSld name="Loop">'
    + _tree(
        '<p:sp><p:nvSpPr><p:cNvPr id="2" name="Title"/><p:cNvSpPr><a:spLocks noGrp="1"/></p:cNvSpPr>'
        '<p:nvPr><p:ph type="title"/></p:nvPr></p:nvSpPr><p:spPr/><p:txBody><a:bodyPr/><a:lstStyle/>'
        "<a:p><a:r><a:t>Title</a:t></a:r></a:p></p:txBody></p:sp>"
    )
    + f"</p:cSld>{_COLOURS_OF_MASTER}</p:sldLayout>"
)
_NOTES_MASTER = (
    f"{_HEAD}<p:notesMaster {_SPACES}><p:cSld>{_WHITE}"
    + _tree(
        '<p:sp><p:nvSpPr><p:cNvPr id="2" name="Slide"/><p:cNvSpPr><a:spLocks noGrp="1" noRot="1" '
        'noChangeAspect="1"/></p:cNvSpPr><p:nvPr><p:ph type="sldImg"/></p:nvPr></p:nvSpPr><p:spPr><a:xfrm>'
        '<a:off x="685800" y="1143000"/><a:ext cx="5486400" cy="3086100"/></a:xfrm>'
        '<a:prstGeom prst="rect"><a:avLst/></a:prstGeom></p:spPr></p:sp>'
        '<p:sp><p:nvSpPr><p:cNvPr id="3" name="Notes"/><p:cNvSpPr><a:spLocks noGrp="1"/></p:cNvSpPr>'
        '<p:nvPr><p:ph type="body" idx="1"/></p:nvPr></p:nvSpPr><p:spPr><a:xfrm>'
        '<a:off x="685800" y="4400550"/><a:ext cx="5486400" cy="3600450"/></a:xfrm>'
        '<a:prstGeom prst="rect"><a:avLst/></a:prstGeom></p:spPr><p:txBody><a:bodyPr/><a:lstStyle/>'
        "<a:p><a:r><a:t>Notes</a:t></a:r></a:p></p:txBody></p:sp>"
    )
    + f"</p:cSld>{_COLOURS}</p:notesMaster>"
)
_LINE = '<a:ln w="6350"><a:solidFill><a:schemeClr val="phClr"/></a:solidFill></a:ln>'
_FILL = '<a:solidFill><a:schemeClr val="phClr"/></a:solidFill>'
_EFFECT = "<a:effectStyle><a:effectLst/></a:effectStyle>"
_FONT = '<a:latin typeface="{}"/><a:ea typeface=""/><a:cs typeface=""/>'.format("Arial")
_THEME = (
    f'{_HEAD}<a:theme xmlns:a="{_A}" name="linkanim"><a:themeElements><a:clrScheme name="linkanim">'
    + "".join(
        f'<a:{name}><a:srgbClr val="{value}"/></a:{name}>'
        for name, value in {
            **{"dk1": "1C1E26", "lt1": "FFFFFF", "dk2": "3C404A", "lt2": "ECEEF2", "accent1": "0072B2"},
            **{"accent2": "D55E00", "accent3": "009E73", "accent4": "E69F00", "accent5": "56B4E9"},
            **{"accent6": "CC79A7", "hlink": "0072B2", "folHlink": "CC79A7"},
        }.items()
    )
    + f'</a:clrScheme><a:fontScheme name="linkanim"><a:majorFont>{_FONT}</a:majorFont>'
    f'<a:minorFont>{_FONT}</a:minorFont></a:fontScheme><a:fmtScheme name="linkanim">'
    f"<a:fillStyleLst>{_FILL * 3}</a:fillStyleLst><a:lnStyleLst>{_LINE * 3}</a:lnStyleLst>"
    f"<a:effectStyleLst>{_EFFECT * 3}</a:effectStyleLst><a:bgFillStyleLst>{_FILL * 3}</a:bgFillStyleLst>"
    "</a:fmtScheme></a:themeElements></a:theme>"
)
