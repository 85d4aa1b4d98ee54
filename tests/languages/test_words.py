"""Words in other languages: which is spoken, and catalogues in step with the sentences of the code."""

from __future__ import annotations

import re
import threading
from collections import Counter
from gettext import GNUTranslations

import pytest
from catalogue import TRANSLATED, first, path_of, read, sentences

from linkanim import words
from linkanim import words as spoken_words
from linkanim.words import language_named, language_of, row_said, said, speaking

_PLACE = re.compile(r"\{[a-z_]*\}")

NAMES = {
    # as systems write them, and as browsers do
    "zh_TW": "zh_TW",
    "zh_TW.UTF-8": "zh_TW",
    "zh_HK": "zh_TW",
    "zh-Hant-MO": "zh_TW",
    "zh_CN.GB18030@pinyin": "zh_CN",
    "zh_SG": "zh_CN",
    "zh": "zh_CN",
    "en_GB.UTF-8": "en",
    "C.UTF-8": "en",
    "POSIX": "en",
    # there is no catalogue of these
    "fr_FR": None,
    "zhuang": None,
    "": None,
}


@pytest.mark.parametrize(("name", "language"), NAMES.items(), ids=[name or "empty" for name in NAMES])
def test_a_language_is_known_by_its_names(name: str, language: str | None) -> None:
    assert language_named(name) == language


ENVIRONMENTS: dict[str, tuple[dict[str, str], str]] = {
    "nothing is set": ({}, "en"),
    "LANG alone": ({"LANG": "zh_TW.UTF-8"}, "zh_TW"),
    "LANGUAGE comes first": ({"LANGUAGE": "zh_CN", "LC_ALL": "zh_TW", "LANG": "en_US"}, "zh_CN"),
    "the first that is here of several": ({"LANGUAGE": "fr:zh_TW:en"}, "zh_TW"),
    "an empty one is not set": ({"LANGUAGE": "", "LC_MESSAGES": "zh_CN.UTF-8"}, "zh_CN"),
    "none that is here": ({"LANG": "fr_FR.UTF-8"}, "en"),
}


@pytest.mark.parametrize("case", ENVIRONMENTS)
def test_the_environment_asks_for_a_language_as_gettext_has_it(case: str) -> None:
    environment, language = ENVIRONMENTS[case]
    assert language_of(environment) == language


def test_a_language_is_spoken_while_its_block_runs_and_by_its_thread_alone() -> None:
    heard: list[str] = []
    with speaking("zh_TW"):
        assert words.spoken() == "zh_TW"
        other = threading.Thread(target=lambda: heard.append(words.spoken()))
        other.start()
        other.join()
    assert (words.spoken(), heard) == ("en", ["en"])


def test_what_is_kept_is_kept_by_language() -> None:
    asked: list[str] = []

    @words.kept_as_said(4)
    def kept(what: str) -> str:
        asked.append(words.spoken())
        return said(what)

    for language in ("en", "zh_TW", "en", "zh_TW"):
        with speaking(language):
            kept("names")
    assert asked == ["en", "zh_TW"]


def test_a_sentence_that_no_catalogue_has_is_said_as_it_is() -> None:
    with speaking("zh_CN"):
        assert said("no catalogue has {this}", this="that") == "no catalogue has that"


@pytest.mark.parametrize("language", TRANSLATED)
def test_a_catalogue_has_the_sentences_of_the_code_and_no_others(language: str) -> None:
    """`python tests/languages/catalogue.py` brings them in step."""
    known = {(message.context, first(message.id)): message for message in read(language) if message.id}
    assert sorted(map(str, set(known) ^ set(sentences()))) == []
    assert [message.id for message in known.values() if message.fuzzy] == []
    assert [message.id for message in known.values() if not first(message.string)] == []


@pytest.mark.parametrize("language", TRANSLATED)
def test_a_translation_has_the_places_of_its_sentence(language: str) -> None:
    # where a sentence is counted, one of its forms may say the count in a word
    for message in read(language):
        one = message.id[-1] if isinstance(message.id, (tuple, list)) else message.id
        if one and (written := first(message.string)):
            assert Counter(_PLACE.findall(written)) == Counter(_PLACE.findall(one)), written


@pytest.mark.parametrize("language", TRANSLATED)
def test_what_the_program_reads_is_what_translators_wrote(language: str) -> None:
    with path_of(language, ".mo").open("rb") as file:
        compiled = GNUTranslations(file)
    for message in read(language):
        one, written = first(message.id), first(message.string)
        if isinstance(message.id, tuple):
            assert not written or compiled.ngettext(one, message.id[1], 2) == written
        elif one:
            found = compiled.pgettext(message.context, one) if message.context else compiled.gettext(one)
            assert found == (written or one)


ROWS = {
    "none": ([], "", ""),
    "one": (["a"], "a", "a"),
    "two": (["a", "b"], "a and b", "a與b"),
    "three": (["a", "b", "c"], "a, b and c", "a、b與c"),
}
"""Words in a row, in English and in Chinese."""


@pytest.mark.parametrize("case", ROWS)
def test_words_stand_in_a_row_as_the_language_has_it(case: str) -> None:
    words, english, chinese = ROWS[case]
    assert row_said(words) == english
    with speaking("zh_TW"):
        assert row_said(words) == chinese


def test_sentences_follow_one_another_as_the_language_has_it() -> None:
    assert (
        spoken_words.sentences(),
        spoken_words.sentences("", "One."),
        spoken_words.sentences("One.", "", "Two."),
    ) == ("", "One.", "One. Two.")
    with speaking("zh_TW"):
        assert spoken_words.sentences("一。", "", "二。") == "一。二。"


def test_braces_are_places_only_where_there_are_parts() -> None:
    assert said("v_{B}") == "v_{B}"
    assert said("v_{{B}} of {bar}", bar="A–B") == "v_{B} of A–B"
