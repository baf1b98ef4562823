"""The table of words is read once for a paper's file, however many of its claims name words."""

from pathlib import Path

import pytest

from riserstudy.grading import published
from riserstudy.grading.words_of_size_file import read_words

CONFIG = Path(__file__).parents[2] / "config"


@pytest.mark.parametrize("paper", ["chang2020", "liu2020", "mao_hangoff", "fem_riser", "liu2017"])
def test_a_papers_file_reads_the_words_once(monkeypatch, paper):
    read = []

    def counted(config):
        read.append(config)
        return read_words(config)

    monkeypatch.setattr(published, "read_words", counted)
    file = published.printed_of(CONFIG, paper)
    assert len(file.items) > 5
    assert read == [CONFIG]
