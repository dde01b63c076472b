"""Who has asked too often: by token for those who have a valid one, by address for the others."""

from dataclasses import dataclass

from server.security.callers import Caller
from server.security.rates import Rates
from server.services.time import TimeSource
from server.settings import Settings

SHOTS_PER_REQUEST = 100
"""Shots of a batch that count as one request."""


@dataclass(frozen=True, slots=True)
class Limits:
    """The rates of one server process."""

    callers: Rates
    addresses: Rates

    @classmethod
    def of(cls, settings: Settings, time: TimeSource) -> "Limits":
        """The rates that the settings name."""
        return cls(
            callers=Rates(settings.token_rate, settings.token_burst, time),
            addresses=Rates(settings.address_rate, settings.address_burst, time),
        )

    def count(self, caller: Caller, cost: float = 1.0) -> None:
        """Count a request of somebody with a token; raises `TooManyRequests`."""
        self.callers.take(f"token of {caller.id}", cost)

    def count_shots(self, caller: Caller, shots: int) -> None:
        """Count the shots of a batch; raises `TooManyRequests`."""
        self.count(caller, shots / SHOTS_PER_REQUEST)

    def count_stranger(self, address: str) -> None:
        """Count a request without a valid token; raises `TooManyRequests`."""
        self.addresses.take(f"address {address}")
