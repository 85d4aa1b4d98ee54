"""Rounds of questions in the formats of learning platforms: Moodle XML, and packages of QTI 1.2.

Every question is a choice of one answer, and brings its figure with it. The feedback of a wrong answer is the
misconception that it comes from; that of the question is the reason. Formats: "Moodle XML format" in Moodle's
documentation; IMS Question & Test Interoperability 1.2.1, in a content package (IMS Content Packaging 1.1.3)
as Canvas and others read it.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from base64 import b64encode
from collections.abc import Callable, Iterator, Mapping, Sequence
from hashlib import sha256
from html import escape
from io import BytesIO
from typing import NamedTuple
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from linkanim.picture.raster import png_bytes
from linkanim.play.question import QuizAnswer, QuizQuestion
from linkanim.play.quiz import LETTERS, answer_text, curve_png, figure_words, question_figure
from linkanim.words import said

Rounds = Mapping[str, Sequence[QuizQuestion]]
"""Questions by the name of their chapter."""

_TOP = "$course$/top/linkanim"
_QTI = "http://www.imsglobal.org/xsd/ims_qtiasiv1p2"
_PACKAGE = "http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1"
_IN_PACKAGE = "$IMS-CC-FILEBASE$/"
_PICTURES = "pictures/"
_LONGEST_NAME = 60
_EPOCH = (1980, 1, 1, 0, 0, 0)
"""The fixed date of a package's files, so that the same questions give the same bytes."""


class _Picture(NamedTuple):
    """A PNG picture: its file's name, its bytes, its alternative text, and its width as shown."""

    name: str
    content: bytes
    words: str
    width: int


class _Posed(NamedTuple):
    """A question as both formats need it.

    `ident` is the same for the same question in the same place of a round; `curves` are the pictures of
    answers that are curves, empty for other answers.
    """

    ident: str
    question: QuizQuestion
    figure: _Picture
    curves: tuple[_Picture, ...]

    @property
    def title(self) -> str:
        """Its name in a list of questions."""
        text = f"{self.question.scene.title}: {self.question.text}"
        return text if len(text) <= _LONGEST_NAME else f"{text[: _LONGEST_NAME - 1].rstrip()}…"

    @property
    def shuffled(self) -> bool:
        """Whether the answers may come in any order: not where they are letters in the figure."""
        return all(answer_text(self.question, n) == one.text for n, one in enumerate(self.answers))

    @property
    def answers(self) -> tuple[QuizAnswer, ...]:
        """Its answers, in the order of the letters."""
        return self.question.answers

    def text(self, source: Callable[[_Picture], str]) -> str:
        """Return the question, the figure and where the input is, as HTML."""
        words = escape(figure_words(self.question))
        return f"<p>{escape(self.question.text)}</p><p>{_image(self.figure, source)}</p><p>{words}</p>"

    def answer(self, number: int, source: Callable[[_Picture], str]) -> str:
        """Return an answer, as HTML."""
        shown = f"<br>{_image(self.curves[number], source)}" if self.curves else ""
        return f"<p>{escape(answer_text(self.question, number))}{shown}</p>"

    def feedback(self, number: int) -> str:
        """Return the feedback of an answer, as HTML."""
        slip = self.answers[number].slip
        if number == self.question.right:
            words = said("Right.")
        else:
            words = said("No: that is {slip}.", slip=slip) if slip else said("No.")
        return f"<p>{escape(words)}</p>"

    @property
    def why(self) -> str:
        """The feedback of every answer, as HTML."""
        return f"<p>{escape(self.question.why)}</p>"


def moodle(rounds: Rounds, progress: Callable[[int, int], None] = lambda *_: None) -> bytes:
    """Return questions as Moodle XML, a category for each chapter, the figures in it.

    `progress` is called with (questions written, in all).
    """
    top = ET.Element("quiz")
    for chapter, questions in _asked(rounds, progress):
        entry = ET.SubElement(top, "question", type="category")
        # a slash separates categories; a slash within a name is doubled
        _moodle_text(entry, "category", f"{_TOP}/{chapter.replace('/', '//')}")
        for asked in questions:
            _moodle_question(top, asked)
    return _written(top)


def _moodle_question(top: ET.Element, asked: _Posed) -> None:
    question = ET.SubElement(top, "question", type="multichoice")
    _moodle_text(question, "name", asked.title)
    _moodle_html(question, "questiontext", asked.text(_in_moodle), [asked.figure])
    _moodle_html(question, "generalfeedback", asked.why)
    settings = {
        "defaultgrade": "1",
        "penalty": "0.3333333",
        "hidden": "0",
        "single": "true",
        "shuffleanswers": "true" if asked.shuffled else "false",
        "answernumbering": "none",
        "showstandardinstruction": "0",
    }
    for name, value in settings.items():
        ET.SubElement(question, name).text = value
    for name in ("correctfeedback", "partiallycorrectfeedback", "incorrectfeedback"):
        _moodle_html(question, name, "")
    for number in range(len(asked.answers)):
        fraction = "100" if number == asked.question.right else "0"
        answer = ET.SubElement(question, "answer", fraction=fraction, format="html")
        ET.SubElement(answer, "text").text = asked.answer(number, _in_moodle)
        _moodle_files(answer, asked.curves[number : number + 1])
        _moodle_html(answer, "feedback", asked.feedback(number))


def _in_moodle(picture: _Picture) -> str:
    return f"@@PLUGINFILE@@/{picture.name}"


def _moodle_text(parent: ET.Element, name: str, text: str) -> None:
    ET.SubElement(ET.SubElement(parent, name), "text").text = text


def _moodle_html(parent: ET.Element, name: str, text: str, pictures: Sequence[_Picture] = ()) -> None:
    entry = ET.SubElement(parent, name, format="html")
    ET.SubElement(entry, "text").text = text
    _moodle_files(entry, pictures)


def _moodle_files(parent: ET.Element, pictures: Sequence[_Picture]) -> None:
    for picture in pictures:
        file = ET.SubElement(parent, "file", name=picture.name, path="/", encoding="base64")
        file.text = b64encode(picture.content).decode()


def qti(rounds: Rounds, title: str, progress: Callable[[int, int], None] = lambda *_: None) -> bytes:
    """Return questions as a zipped package of QTI 1.2, an assessment for each chapter, the figures in it.

    `progress` is called with (questions written, in all).
    """
    files: dict[str, bytes] = {}
    resources: list[tuple[str, str, str]] = []
    for number, (chapter, questions) in enumerate(_asked(rounds, progress), 1):
        ident = f"assessment{number}"
        top = ET.Element("questestinterop", xmlns=_QTI)
        heading = title if len(rounds) == 1 else said("{title}: {part}", title=title, part=chapter)
        assessment = ET.SubElement(top, "assessment", ident=ident, title=heading)
        _qti_fields(assessment, {"cc_maxattempts": "1"})
        section = ET.SubElement(assessment, "section", ident="root_section")
        for asked in questions:
            _qti_item(section, asked)
            for picture in (asked.figure, *asked.curves):
                files[f"{_PICTURES}{picture.name}"] = picture.content
        files[f"{ident}/{ident}.xml"] = _written(top)
        resources.append((ident, "imsqti_xmlv1p2", f"{ident}/{ident}.xml"))
    shown = sorted(name for name in files if name.startswith(_PICTURES))
    resources += [(f"picture{number}", "webcontent", name) for number, name in enumerate(shown, 1)]
    return _zipped({"imsmanifest.xml": _manifest(resources)} | files)


def _qti_item(section: ET.Element, asked: _Posed) -> None:
    item = ET.SubElement(section, "item", ident=asked.ident, title=asked.title)
    idents = [f"{asked.ident}{letter}" for letter in LETTERS[: len(asked.answers)]]
    fields = {"question_type": "multiple_choice_question", "points_possible": "1.0"}
    fields["original_answer_ids"] = ",".join(idents)
    _qti_fields(ET.SubElement(item, "itemmetadata"), fields)
    presentation = ET.SubElement(item, "presentation")
    _qti_html(presentation, asked.text(_in_package))
    response = ET.SubElement(presentation, "response_lid", ident="response1", rcardinality="Single")
    choice = ET.SubElement(response, "render_choice", shuffle="Yes" if asked.shuffled else "No")
    for number, ident in enumerate(idents):
        _qti_html(ET.SubElement(choice, "response_label", ident=ident), asked.answer(number, _in_package))
    _qti_processing(item, idents, asked.question.right)
    for number, ident in enumerate(idents):
        _qti_feedback(item, f"{ident}_fb", asked.feedback(number))
    _qti_feedback(item, "general_fb", asked.why)


def _qti_processing(item: ET.Element, idents: Sequence[str], right: int) -> None:
    """Write how an answer is judged: the feedback of all, that of each, and the score of the right one."""
    processing = ET.SubElement(item, "resprocessing")
    outcomes = ET.SubElement(processing, "outcomes")
    ET.SubElement(outcomes, "decvar", maxvalue="100", minvalue="0", varname="SCORE", vartype="Decimal")
    each = ET.SubElement(processing, "respcondition", {"continue": "Yes"})
    ET.SubElement(ET.SubElement(each, "conditionvar"), "other")
    ET.SubElement(each, "displayfeedback", feedbacktype="Response", linkrefid="general_fb")
    for ident in idents:
        chosen = ET.SubElement(processing, "respcondition", {"continue": "Yes"})
        _qti_chosen(chosen, ident)
        ET.SubElement(chosen, "displayfeedback", feedbacktype="Response", linkrefid=f"{ident}_fb")
    scored = ET.SubElement(processing, "respcondition", {"continue": "No"})
    _qti_chosen(scored, idents[right])
    ET.SubElement(scored, "setvar", action="Set", varname="SCORE").text = "100"


def _qti_chosen(condition: ET.Element, ident: str) -> None:
    ET.SubElement(ET.SubElement(condition, "conditionvar"), "varequal", respident="response1").text = ident


def _qti_feedback(item: ET.Element, ident: str, text: str) -> None:
    _qti_html(ET.SubElement(ET.SubElement(item, "itemfeedback", ident=ident), "flow_mat"), text)


def _qti_html(parent: ET.Element, text: str) -> None:
    ET.SubElement(ET.SubElement(parent, "material"), "mattext", texttype="text/html").text = text


def _qti_fields(parent: ET.Element, fields: Mapping[str, str]) -> None:
    metadata = ET.SubElement(parent, "qtimetadata")
    for label, entry in fields.items():
        field = ET.SubElement(metadata, "qtimetadatafield")
        ET.SubElement(field, "fieldlabel").text = label
        ET.SubElement(field, "fieldentry").text = entry


def _in_package(picture: _Picture) -> str:
    return f"{_IN_PACKAGE}{_PICTURES}{picture.name}"


def _manifest(resources: Sequence[tuple[str, str, str]]) -> bytes:
    """Return the manifest of a package: each part's identifier, kind and file."""
    top = ET.Element("manifest", xmlns=_PACKAGE, identifier="linkanim")
    about = ET.SubElement(top, "metadata")
    ET.SubElement(about, "schema").text = "IMS Content"
    ET.SubElement(about, "schemaversion").text = "1.1.3"
    ET.SubElement(top, "organizations")
    listed = ET.SubElement(top, "resources")
    for identifier, kind, path in resources:
        entry = ET.SubElement(listed, "resource", identifier=identifier, type=kind, href=path)
        ET.SubElement(entry, "file", href=path)
    return _written(top)


def _zipped(files: Mapping[str, bytes]) -> bytes:
    target = BytesIO()
    with ZipFile(target, "w", ZIP_DEFLATED) as package:
        for name, content in files.items():
            package.writestr(ZipInfo(name, _EPOCH), content, ZIP_DEFLATED)
    return target.getvalue()


def _written(top: ET.Element) -> bytes:
    ET.indent(top, " ")
    content: bytes = ET.tostring(top, "utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + content + b"\n"


def _image(picture: _Picture, source: Callable[[_Picture], str]) -> str:
    return f'<img src="{source(picture)}" alt="{escape(picture.words)}" width="{picture.width}">'


def _asked(rounds: Rounds, progress: Callable[[int, int], None]) -> Iterator[tuple[str, Iterator[_Posed]]]:
    """Yield the chapters, each with its questions as they are drawn."""
    numbers, count = iter(range(1, 10**9)), sum(map(len, rounds.values()))

    def drawn(question: QuizQuestion) -> _Posed:
        number = next(numbers)
        asked = _drawn(question, number)
        progress(number, count)
        return asked

    for chapter, questions in rounds.items():
        yield chapter, map(drawn, questions)


def _drawn(question: QuizQuestion, number: int) -> _Posed:
    ident = f"q{number}x{sha256(str(question.question_id).encode()).hexdigest()[:12]}"
    shown = question_figure(question)
    figure = _Picture(
        f"{ident}.png",
        png_bytes(shown.surface()),
        said("{found}.", found=figure_words(question)),
        shown.size[0],
    )
    curves = (
        _Picture(
            f"{ident}{letter}.png", curve_png(one.curve), said("{curve} over one period", curve=one.text), 160
        )
        for letter, one in zip(LETTERS, question.answers, strict=False)
        if one.curve
    )
    return _Posed(ident, question, figure, tuple(curves))
