"""What the page about the results database shows."""

import re
from pathlib import Path

TEXT = (Path(__file__).parents[2] / "docs/results_database.md").read_text("utf-8")
QUESTION = re.compile(r"^### (\d+)\. .*?```sql\n(.*?)\n```\n\n```text\n(.*?)\n```", re.M | re.S)
#: number, statement, answer
QUESTIONS = [(int(number), sql, answer) for number, sql, answer in QUESTION.findall(TEXT)]
COMMANDS = re.findall(r"^riserstudy .*", TEXT, re.M)
PYTHON = re.findall(r"```python\n(.*?)```", TEXT, re.S)[0]
