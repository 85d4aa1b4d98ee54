"""What learning platforms are given is valid, and an independent reader finds every question in it again."""

from __future__ import annotations

import struct
import xml.etree.ElementTree as ET
from base64 import b64decode
from html.parser import HTMLParser
from io import BytesIO
from pathlib import Path
from typing import NamedTuple
from zipfile import ZipFile

import pytest

from linkanim.cli import main
from linkanim.play.platforms import moodle, qti
from linkanim.play.question import QuestionId, QuizQuestion
from linkanim.play.quiz import question_of, questions
from linkanim.scenes import chapters, load, names

CENTRE = question_of(QuestionId.of("instant_centre@crank-rocker@4.6593@coupler"))
ROUNDS = {"Four-bars": questions((load("crank-rocker"),), 12, 3), "A/B & <C>": (CENTRE,)}
QTI = "{http://www.imsglobal.org/xsd/ims_qtiasiv1p2}"
PACKAGE = "{http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1}"


class Found(NamedTuple):
    """A question as a platform has it: its words, answers, the right one's number, what each is told, why."""

    text: str
    answers: tuple[str, ...]
    right: int
    told: tuple[str, ...]
    why: str
    pictures: int


class Page(HTMLParser):
    """The words of HTML, and the sources and alternatives of its pictures."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.words: list[str] = []
        self.pictures: dict[str, str] = {}
        self.open: list[str] = []
        self.feed(html)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        known = dict(attrs)
        if tag == "img":
            self.pictures[known["src"] or ""] = known["alt"] or ""
        elif tag != "br":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(self.words)


# Content models, after Moodle's page on its XML format and the DTD of QTI 1.2.1: for each element its
# children in their order, each with how often it may come (1, ? or *), and its attributes; "#" is text.
HTML = ({"text": "1", "file": "*"}, {"format"})
MOODLE: dict[str, tuple[dict[str, str], set[str]]] = {
    "quiz": ({"question": "*"}, set()),
    "question": (
        {
            "category": "?", "name": "?", "questiontext": "?", "generalfeedback": "?", "defaultgrade": "?",
            "penalty": "?", "hidden": "?", "single": "?", "shuffleanswers": "?", "answernumbering": "?",
            "showstandardinstruction": "?", "correctfeedback": "?", "partiallycorrectfeedback": "?",
            "incorrectfeedback": "?", "answer": "*",
        },
        {"type"},
    ),
    "category": ({"text": "1"}, set()), "name": ({"text": "1"}, set()),
    "questiontext": HTML, "generalfeedback": HTML, "correctfeedback": HTML, "partiallycorrectfeedback": HTML,
    "incorrectfeedback": HTML, "feedback": HTML,
    "answer": ({"text": "1", "file": "*", "feedback": "1"}, {"fraction", "format"}),
    "file": ({"#": "1"}, {"name", "path", "encoding"}),
    **{name: ({"#": "1"}, set()) for name in (
        "text", "defaultgrade", "penalty", "hidden", "single", "shuffleanswers", "answernumbering",
        "showstandardinstruction",
    )},
}  # fmt: skip
ASSESSMENT: dict[str, tuple[dict[str, str], set[str]]] = {
    "questestinterop": ({"assessment": "1"}, set()),
    "assessment": ({"qtimetadata": "*", "section": "*"}, {"ident", "title"}),
    "section": ({"item": "*"}, {"ident"}),
    "item": (
        {"itemmetadata": "1", "presentation": "1", "resprocessing": "*", "itemfeedback": "*"},
        {"ident", "title"},
    ),
    "itemmetadata": ({"qtimetadata": "*"}, set()),
    "qtimetadata": ({"qtimetadatafield": "*"}, set()),
    "qtimetadatafield": ({"fieldlabel": "1", "fieldentry": "1"}, set()),
    "presentation": ({"material": "1", "response_lid": "1"}, set()),
    "response_lid": ({"render_choice": "1"}, {"ident", "rcardinality"}),
    "render_choice": ({"response_label": "*"}, {"shuffle"}),
    "response_label": ({"material": "*"}, {"ident"}),
    "resprocessing": ({"outcomes": "1", "respcondition": "*"}, set()),
    "outcomes": ({"decvar": "*"}, set()),
    "decvar": ({}, {"maxvalue", "minvalue", "varname", "vartype"}),
    "respcondition": ({"conditionvar": "1", "setvar": "*", "displayfeedback": "*"}, {"continue"}),
    "conditionvar": ({"varequal": "?", "other": "?"}, set()),
    "other": ({}, set()),
    "displayfeedback": ({}, {"feedbacktype", "linkrefid"}),
    "itemfeedback": ({"flow_mat": "1"}, {"ident"}),
    "flow_mat": ({"material": "1"}, set()),
    "material": ({"mattext": "1"}, set()),
    "mattext": ({"#": "1"}, {"texttype"}),
    "varequal": ({"#": "1"}, {"respident"}),
    "setvar": ({"#": "1"}, {"action", "varname"}),
    "fieldlabel": ({"#": "1"}, set()), "fieldentry": ({"#": "1"}, set()),
}  # fmt: skip
MANIFEST: dict[str, tuple[dict[str, str], set[str]]] = {
    "manifest": ({"metadata": "?", "organizations": "1", "resources": "1"}, {"identifier"}),
    "metadata": ({"schema": "?", "schemaversion": "?"}, set()),
    "schema": ({"#": "1"}, set()), "schemaversion": ({"#": "1"}, set()),
    "organizations": ({}, set()),
    "resources": ({"resource": "*"}, set()),
    "resource": ({"file": "*"}, {"identifier", "type", "href"}),
    "file": ({}, {"href"}),
}  # fmt: skip


def invalid(
    element: ET.Element, models: dict[str, tuple[dict[str, str], set[str]]], space: str = ""
) -> list[str]:
    """Return what an element has that its content model has not."""
    name = element.tag.removeprefix(space)
    if not element.tag.startswith(space) or name not in models:
        return [f"unknown {element.tag}"]
    children, attributes = models[name]
    wrong = [f"{name}: attributes {sorted(element.keys())}"] if set(element.keys()) != attributes else []
    if "#" not in children and (element.text or "").strip():
        wrong.append(f"{name}: text")
    order, tags = list(children), [child.tag.removeprefix(space) for child in element]
    if any(tag not in order for tag in tags) or tags != sorted(tags, key=order.index):
        wrong.append(f"{name}: children {tags}")
    for child, often in children.items():
        if child != "#" and {"1": tags.count(child) != 1, "?": tags.count(child) > 1}.get(often, False):
            wrong.append(f"{name}: {tags.count(child)} of {child}")
    return [*wrong, *(fault for child in element for fault in invalid(child, models, space))]


def is_picture(content: bytes) -> bool:
    width, height = struct.unpack(">II", content[16:24])
    return content[:8] == b"\x89PNG\r\n\x1a\n" and width >= 160 and height > 30


def read_moodle(content: bytes) -> dict[str, list[Found]]:
    """Return what Moodle makes of a file: a question's category is the last one before it."""
    top = ET.fromstring(content)
    assert invalid(top, MOODLE) == []
    category, found = "", dict[str, list[Found]]()
    for question in top:
        if question.get("type") == "category":
            category = question.findtext("category/text") or ""
            found[category] = []
            continue
        assert question.get("type") == "multichoice"
        assert question.findtext("single") == "true"
        assert len(question.findtext("name/text") or "") <= 255
        worded = [*question.findall("questiontext"), *question.findall("answer")]
        pages = [Page(entry.findtext("text") or "") for entry in worded]
        linked = {source.removeprefix("@@PLUGINFILE@@/") for page in pages for source in page.pictures}
        files = {
            file.get("name"): b64decode(file.text or "", validate=True) for file in question.iter("file")
        }
        assert linked == files.keys()
        assert all(map(is_picture, files.values()))
        assert all(words for page in pages for words in page.pictures.values())
        answers = question.findall("answer")
        shares = [float(answer.get("fraction") or 0) for answer in answers]
        assert sorted(shares)[-2:] == [0, 100]
        told = tuple(Page(answer.findtext("feedback/text") or "").text for answer in answers)
        why = Page(question.findtext("generalfeedback/text") or "").text
        texts = tuple(page.text for page in pages[1:])
        found[category].append(Found(pages[0].words[0], texts, shares.index(100), told, why, len(files)))
    return found


def read_qti(content: bytes) -> dict[str, list[Found]]:
    """Return what a platform makes of a package: each assessment by its title, its items answered in turn."""
    with ZipFile(BytesIO(content)) as package:
        files = {name: package.read(name) for name in package.namelist()}
    manifest = ET.fromstring(files["imsmanifest.xml"])
    assert invalid(manifest, MANIFEST, PACKAGE) == []
    listed = {file.get("href") for file in manifest.iter(f"{PACKAGE}file")}
    assert listed == files.keys() - {"imsmanifest.xml"}
    found = {}
    for resource in manifest.iter(f"{PACKAGE}resource"):
        if resource.get("type") == "imsqti_xmlv1p2":
            top = ET.fromstring(files[resource.get("href") or ""])
            assert invalid(top, ASSESSMENT, QTI) == []
            items = [read_item(item, files) for item in top.iter(f"{QTI}item")]
            found[next(top.iter(f"{QTI}assessment")).get("title") or ""] = items
    return found


def read_item(item: ET.Element, files: dict[str, bytes]) -> Found:
    def page(of: ET.Element) -> Page:
        return Page(next(of.iter(f"{QTI}mattext")).text or "")

    labels = list(item.iter(f"{QTI}response_label"))
    feedback = {one.get("ident"): page(one).text for one in item.iter(f"{QTI}itemfeedback")}
    scores, told = [], []
    for label in labels:
        score, given = 0.0, list[str]()
        for condition in item.iter(f"{QTI}respcondition"):
            equal = next(condition.iter(f"{QTI}varequal"), None)
            if equal is not None and equal.text != label.get("ident"):
                continue
            given += [feedback[one.get("linkrefid")] for one in condition.iter(f"{QTI}displayfeedback")]
            score = float(next((one.text or "0" for one in condition.iter(f"{QTI}setvar")), score))
            if condition.get("continue") == "No":
                break
        scores.append(score)
        told.append(given)
    pages = [page(next(item.iter(f"{QTI}presentation"))), *map(page, labels)]
    pictures = [source for one in pages for source in one.pictures]
    assert all(is_picture(files[source.removeprefix("$IMS-CC-FILEBASE$/")]) for source in pictures)
    whys = {given[0] for given in told}
    assert len(whys) == 1
    assert sorted(scores)[-2:] == [0, 100]
    texts, kept = tuple(one.text for one in pages[1:]), tuple(given[1] for given in told)
    return Found(pages[0].words[0], texts, scores.index(100), kept, whys.pop(), len(pictures))


def expected(question: QuizQuestion) -> Found:
    told = [f"No: that is {one.slip}." if one.slip else "No." for one in question.answers]
    told[question.right] = "Right."
    dots = question.kind == "instant centre"
    answers = [f"at {letter}" for letter in "abcd"] if dots else [one.text for one in question.answers]
    pictures = 1 + sum(bool(one.curve) for one in question.answers)
    shown = tuple(answers[: len(question.answers)])
    return Found(question.text, shown, question.right, tuple(told), question.why, pictures)


@pytest.mark.slow
def test_questions_come_back_from_moodle_in_their_categories() -> None:
    found = read_moodle(moodle(ROUNDS))
    assert list(found) == ["$course$/top/linkanim/Four-bars", "$course$/top/linkanim/A//B & <C>"]
    assert list(found.values()) == [[*map(expected, asked)] for asked in ROUNDS.values()]
    assert any(one.pictures > 1 for one in found["$course$/top/linkanim/Four-bars"])


@pytest.mark.slow
def test_questions_come_back_from_a_package() -> None:
    content = qti(ROUNDS, "Round")
    found = read_qti(content)
    assert list(found) == ["Round: Four-bars", "Round: A/B & <C>"]
    assert list(found.values()) == [[*map(expected, asked)] for asked in ROUNDS.values()]
    assert qti(ROUNDS, "Round") == content


def test_a_dot_keeps_its_letter_where_answers_are_shuffled() -> None:
    top = ET.fromstring(moodle({"Four-bars": (CENTRE, *ROUNDS["Four-bars"][:1])}))
    assert [one.text for one in top.iter("shuffleanswers")] == ["false", "true"]


@pytest.mark.long
def test_a_question_on_every_scene_is_written_for_both(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    xml, package = tmp_path / "all.xml", tmp_path / "all.zip"
    count = str(len(names()))
    assert main(["quiz", "all", "-n", count, "--moodle", str(xml), "--qti", str(package)]) == 0
    assert capsys.readouterr().out.split() == [str(xml), str(package)]
    found, packed = read_moodle(xml.read_bytes()), read_qti(package.read_bytes())
    assert len(found) == len(chapters())
    assert {name: len(asked) for name, asked in zip(chapters(), found.values(), strict=True)} == {
        name: len(scenes) for name, scenes in chapters().items()
    }
    assert list(packed.values()) == list(found.values())


@pytest.mark.parametrize("option", ["--moodle", "--qti"])
def test_another_ending_is_refused(option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["quiz", "press", option, str(tmp_path / "out.txt")]) == 2
    assert ".xml" in (said := capsys.readouterr().err) or ".zip" in said
    assert not list(tmp_path.iterdir())
