"""The bare endpoint: one transaction of so many bytes, flushed to disk, then an answer of so many bytes.

FastAPI, uvicorn and SQLite as the server has them (WAL, synchronous=FULL, one writer, one process), and nothing
else: the statement goes to the driver itself.
"""

import argparse
import json
import secrets
import sqlite3
import threading

import uvicorn
from fastapi import FastAPI, Request, Response
from starlette.concurrency import run_in_threadpool

from server.serve import listening


def app_of(database: str, answer_size: int, stored_size: int) -> FastAPI:
    """The application."""
    app = FastAPI()
    connection = sqlite3.connect(database, isolation_level=None, check_same_thread=False)
    for pragma in ("journal_mode = WAL", "synchronous = FULL"):
        connection.execute(f"PRAGMA {pragma}")
    connection.execute("CREATE TABLE IF NOT EXISTS rows (id INTEGER PRIMARY KEY, body BLOB)")
    answer = json.dumps({"answer": "x" * (answer_size - 14)}).encode()
    stored, writer = secrets.token_bytes(stored_size), threading.Lock()

    def store() -> None:
        with writer:
            connection.execute("BEGIN IMMEDIATE")
            connection.execute("INSERT INTO rows (body) VALUES (?)", (stored,))
            connection.execute("COMMIT")

    @app.post("/shot")
    async def shot(request: Request) -> Response:
        json.loads(await request.body())
        await run_in_threadpool(store)
        return Response(answer, media_type="application/json")

    return app


def main() -> None:
    """Serve until a signal, the address announced as the server does."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("--port", "--answer", "--store"):
        parser.add_argument(name, type=int, required=True)
    parser.add_argument("--database", required=True)
    options = parser.parse_args()
    with listening("127.0.0.1", options.port) as server_socket:
        print(json.dumps({"url": f"http://127.0.0.1:{server_socket.getsockname()[1]}"}), flush=True)
        app = app_of(options.database, options.answer, options.store)
        config = uvicorn.Config(
            app,
            http="httptools",
            loop="uvloop",
            ws="none",
            access_log=False,
            log_level="warning",
            server_header=False,
        )
        uvicorn.Server(config).run([server_socket])


if __name__ == "__main__":
    main()
