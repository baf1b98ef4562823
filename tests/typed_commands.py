"""Command lines as a page shows them, run in this process: to start another one takes most of their time."""

import shlex


def typed(text, commands):
    """Run lines up to the first that fails, as ``bash -e``: exit status, all output and all messages."""
    code, said, complained = 0, "", ""
    for line in filter(None, map(str.strip, text.splitlines())):
        words = shlex.split(line, comments=True)
        may_fail = words[-2:] == ["||", "true"]
        program, *rest = words[:-2] if may_fail else words
        assert program == "riserstudy", line
        code, out, messages = commands(*rest)
        said, complained = said + out, complained + messages
        code = 0 if may_fail else code
        if code:
            break
    return code, said, complained
