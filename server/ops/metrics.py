"""What the server counts and measures, for Prometheus.

Each process counts for itself. Where several serve one address `PROMETHEUS_MULTIPROC_DIR` names a folder that they
share, and whichever is asked answers for all.
"""

import os
from collections.abc import Iterable

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, ProcessCollector, generate_latest
from prometheus_client.metrics_core import GaugeMetricFamily, Metric
from prometheus_client.multiprocess import MultiProcessCollector
from prometheus_client.registry import Collector
from sqlalchemy import func, select

from server.errors import Unavailable
from server.store.database import Database
from server.store.tables import games

SHARED_FOLDER = "PROMETHEUS_MULTIPROC_DIR"
BUCKETS = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0)
"""Seconds: from a read to the longest poll."""


class Metrics:
    """The counters of one process."""

    def __init__(self) -> None:
        registry = self._registry = CollectorRegistry()
        self.requests = Counter(
            "pooliad_requests", "Requests answered.", ["method", "route", "status"], registry=registry
        )
        self.request_seconds = Histogram(
            "pooliad_request_seconds", "From the head of a request to the end of its answer.", ["method", "route"],
            buckets=BUCKETS, registry=registry,
        )  # fmt: skip
        self.in_progress = Gauge(
            "pooliad_requests_in_progress", "Requests being answered, long polls and streams among them.",
            registry=registry, multiprocess_mode="livesum",
        )  # fmt: skip
        self.strokes = Counter("pooliad_strokes", "Strokes and decisions stored.", registry=registry)
        self.stroke_seconds = Histogram(
            "pooliad_stroke_seconds", "From the last byte of a stroke to its being stored.",
            buckets=BUCKETS, registry=registry,
        )  # fmt: skip
        self.games_ended = Counter("pooliad_games_ended", "Games that ended.", ["reason"], registry=registry)
        self.simulated = Counter("pooliad_simulated_shots", "Shots simulated for clients.", registry=registry)
        ProcessCollector(registry=registry)

    def text(self, database: Database) -> bytes:
        """Everything in Prometheus' text format."""
        registry = self._registry
        if SHARED_FOLDER in os.environ:
            registry = CollectorRegistry()
            MultiProcessCollector(registry)  # type: ignore[no-untyped-call]
        running = CollectorRegistry()
        running.register(_Games(database))
        return generate_latest(registry) + generate_latest(running)


class _Games(Collector):
    """What the database knows at the moment."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def collect(self) -> Iterable[Metric]:
        """The games that are on; nothing while the database does not answer, for then all else is wanted."""
        try:
            with self._database.reading() as connection:
                running = connection.scalar(select(func.count()).where(games.c.mover.is_not(None))) or 0
        except Unavailable:
            return
        yield GaugeMetricFamily("pooliad_games_running", "Games that are on, whoever serves them.", value=running)
