"""An organiser makes a match on a table file:

    python examples/calibration/play.py my_table.toml Ann greedy

The variables POOLIAD_URL and POOLIAD_ORGANISER_TOKEN say where and by whose right. Ann's page enters the match at once.
"""

import os
import sys
from collections.abc import Iterator
from pathlib import Path

from client import Pooliad, PooliadError
from physics import InvalidTable
from physics.table_file import read_table
from protocol import AgentView, MatchRequest


def main(file: str, first: str, second: str) -> None:
    """Make it; one sentence and exit code 1 where that cannot be."""
    try:
        table = read_table(Path(file))
        with Pooliad(os.environ["POOLIAD_URL"], os.environ["POOLIAD_ORGANISER_TOKEN"]) as organiser:
            ids = {agent.name: agent.id for agent in registered(organiser)}
            request = MatchRequest(agents=(ids[first], ids[second]), table=table.to_dict(), rated=False)
            match = organiser.create_match(request)
    except KeyError as error:
        sys.exit(f"{error.args[0]}: must be the name of an agent, or be set in the environment")
    except (InvalidTable, OSError, PooliadError) as error:
        sys.exit(str(error))
    sys.stdout.write(f"{match.id}: {' against '.join(match.players)} on {file}\n")


def registered(server: Pooliad) -> Iterator[AgentView]:
    """All agents of a server."""
    page = server.agents()
    yield from page.agents
    while page.next_cursor is not None:
        page = server.agents(page.next_cursor)
        yield from page.agents


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
