"""The player of an earlier commit, for `lockstep`: started by file in a checkout of its own, which PYTHONPATH names.

It imports nothing of `benchmarks`. Its argument is the agent's name, and its seed follows. Each line of its input is a
game's name and a view of it; it answers with the action, the processor time it took, s, and the shots it simulated.
"""

import json
import sys
import time
from pathlib import Path
from typing import Any


def main() -> None:
    """Answer until the input ends."""
    import physics
    from client.agent import View  # type: ignore[attr-defined]  # where an earlier commit has it
    from client.agents.registry import load

    factory, agents = load(sys.argv[1], int(sys.argv[2])), {}
    print(json.dumps({"file": str(Path(physics.__file__).resolve())}), flush=True)
    for line in sys.stdin:
        asked = json.loads(line)
        view = View.model_validate_json(asked["view"])
        if asked["game"] not in agents:
            agents[asked["game"]] = factory()
            agents[asked["game"]].game_started(view)
        agent = agents[asked["game"]]
        started = time.process_time()
        action = agent.choose(view)
        seconds = time.process_time() - started
        answer: dict[str, Any] = {"action": action.to_dict(), "seconds": seconds, "simulated": _simulated(agent)}
        print(json.dumps(answer), flush=True)


def _simulated(agent: Any) -> int:
    """Shots of its last thought, as far as it tells."""
    thoughts = getattr(agent, "thoughts", [])
    return int(thoughts[-1].simulated) if thoughts else 0


if __name__ == "__main__":
    main()
