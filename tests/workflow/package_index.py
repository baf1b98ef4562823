"""A package index on this machine: small packages, served or in folders, for tests of the installer."""

import base64
import hashlib
import io
import ssl
import subprocess
import tarfile
import threading
import zipfile
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import urlsplit


def wheel(name, text="answer = 42\n"):
    """File name and content of a wheel with one module."""
    about = f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n"
    kind = "Wheel-Version: 1.0\nGenerator: test\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
    info = f"{name}-1.0.dist-info"
    files = {f"{name}.py": text, f"{info}/METADATA": about, f"{info}/WHEEL": kind}
    lines = [f"{file},sha256={digest(content)},{len(content)}" for file, content in files.items()]
    files[f"{info}/RECORD"] = "\n".join([*lines, f"{info}/RECORD,,"]) + "\n"
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w") as archive:
        for file, content in files.items():
            archive.writestr(zipfile.ZipInfo(file), content)
    return f"{name}-1.0-py3-none-any.whl", whole.getvalue()


def digest(content):
    """Hash of a file, as RECORD has it."""
    found = hashlib.sha256(content.encode()).digest()
    return base64.urlsafe_b64encode(found).rstrip(b"=").decode()


def source(name, files):
    """File name and content of a source distribution."""
    whole = io.BytesIO()
    files = files | {"PKG-INFO": f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n"}
    with tarfile.open(fileobj=whole, mode="w:gz") as archive:
        for file, text in files.items():
            entry = tarfile.TarInfo(f"{name}-1.0/{file}")
            entry.size = len(text.encode())
            archive.addfile(entry, io.BytesIO(text.encode()))
    return f"{name}-1.0.tar.gz", whole.getvalue()


def lock(name, content):
    """A lock of one package."""
    return f"{name}==1.0 \\\n    --hash=sha256:{hashlib.sha256(content).hexdigest()}\n"


def lay_out(folder, name, files):
    """The same index as a folder: pages and files."""
    page = folder / "simple" / name
    page.mkdir(parents=True, exist_ok=True)
    for file, content in files.items():
        (page / file).write_bytes(content)
    (page / "index.html").write_text("".join(f'<a href="{file}">{file}</a>' for file in files))
    return (folder / "simple").as_uri()


@contextmanager
def served(packages, certificate=None):
    """Serve packages (files by name of package); yields the address, and which paths were asked for.

    Asked as a proxy, it answers for any host.
    """
    asked = []

    class Answer(BaseHTTPRequestHandler):
        def do_GET(self):
            asked.append(self.path)
            _, name, *rest = [*urlsplit(self.path).path.strip("/").split("/"), ""]
            files = packages.get(name, {})
            file = rest[0] if rest else ""
            if file in files:
                self.reply(200, files[file], "application/octet-stream")
            elif files and not file:
                links = "".join(f'<a href="{one}">{one}</a>' for one in files)
                self.reply(200, f"<!DOCTYPE html><body>{links}</body>".encode(), "text/html")
            else:
                self.reply(404, b"", "text/html")

        do_HEAD = do_GET

        def reply(self, status, content, kind):
            self.send_response(status)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(content)))
            self.end_headers()
            if self.command == "GET":
                self.wfile.write(content)

        def log_message(self, *_):
            """Say nothing."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), Answer)
    if certificate:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(*certificate)
        server.socket = context.wrap_socket(server.socket, server_side=True)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"{'https' if certificate else 'http'}://127.0.0.1:{server.server_port}", asked
    finally:
        server.shutdown()
        server.server_close()


def certificate(folder):
    """An authority that nobody trusts; a certificate of this machine signed by it, and its key."""
    authority, key, request, own = (folder / name for name in ("ca.pem", "key.pem", "csr", "own.pem"))
    extensions = folder / "extensions"
    extensions.write_text("subjectAltName=IP:127.0.0.1\n")
    new = ["openssl", "req", "-newkey", "rsa:2048", "-nodes"]
    ca_key = folder / "ca.key"
    sign = ["openssl", "x509", "-req", "-days", "2", "-CA", authority, "-CAkey", ca_key]
    sign += ["-CAcreateserial"]
    for command in (
        [*new, "-x509", "-days", "2", "-subj", "/CN=nobody", "-keyout", ca_key, "-out", authority],
        [*new, "-subj", "/CN=127.0.0.1", "-keyout", key, "-out", request],
        [*sign, "-in", request, "-extfile", extensions, "-out", own],
    ):
        subprocess.run([str(word) for word in command], check=True, capture_output=True)
    return authority, (own, key)
