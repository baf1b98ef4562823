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
check snakefmt --check Snakefile workflow/rules
check snakemake --lint
check lint-imports
check codespell
exit $status
