#!/bin/sh
# Every check of `make check`: silent when all is well, otherwise what each failing tool said.

status=0

check() {
    if ! said=$("$@" 2>&1); then
        printf '== %s\n%s\n' "$*" "$said"
        status=1
    fi
}

check ruff format --check
check ruff check
check mypy --no-error-summary
check snakefmt --check Snakefile workflow/Snakefile workflow/rules src/riserstudy/study/template/Snakefile
check python workflow/scripts/lint_workflow.py
check lint-imports
check python workflow/scripts/check_docstrings.py
check codespell
check python workflow/scripts/check_words.py
check sphinx-build -q -W -b dummy docs build/checked-docs
exit $status
