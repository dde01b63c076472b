"""Who has asked too often or has too much open: by token for those who have a valid one, by address for the others."""

from contextlib import AbstractContextManager
from dataclasses import dataclass

from server.security.callers import Caller
from server.security.places import Places
from server.security.rates import Rates
from server.services.runtime.time import TimeSource
from server.settings import Settings

SHOTS_PER_REQUEST = 100
"""Shots of a batch that count as one request."""


@dataclass(frozen=True, slots=True)
class RequestLimits:
    """The rates of one server process, its streams and long polls."""

    callers: Rates
    addresses: Rates
    registrations: Rates
    streams: Places
    polls: Places

    @classmethod
    def of(cls, settings: Settings, time: TimeSource) -> "RequestLimits":
        """What the settings name."""
        return cls(
            callers=Rates(settings.token_rate, settings.token_burst, time),
            addresses=Rates(settings.address_rate, settings.address_burst, time),
            registrations=Rates(settings.registration_rate, settings.registration_burst, time),
            streams=Places("streams", settings.streams),
            polls=Places("polls", settings.polls),
        )

    def count(self, caller: Caller, cost: float = 1.0) -> None:
        """Count a request of somebody with a token; raises `TooManyRequests`."""
        self.callers.take(_token(caller), cost)

    def count_shots(self, caller: Caller, shots: int) -> None:
        """Count the shots of a batch; raises `TooManyRequests`."""
        self.count(caller, shots / SHOTS_PER_REQUEST)

    def count_stranger(self, address: str) -> None:
        """Count a request without a valid token; raises `TooManyRequests`."""
        self.addresses.take(_address(address))

    def count_registration(self, address: str) -> None:
        """Count an agent that somebody who is no organiser registers; raises `TooManyRequests`."""
        self.registrations.take(f"registrations of {_address(address)}")

    def watching(self, caller: Caller | None, address: str) -> AbstractContextManager[None]:
        """A place to watch from, for the length of a stream; raises `TooManyOpen`."""
        return self.streams.one(_address(address) if caller is None else _token(caller))

    def waiting(self, caller: Caller) -> AbstractContextManager[None]:
        """A place to wait for news, for the length of a long poll; raises `TooManyOpen`."""
        return self.polls.one(_token(caller))


def _token(caller: Caller) -> str:
    return f"token of {caller.id}"


def _address(address: str) -> str:
    return f"address {address}"
