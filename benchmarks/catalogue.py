"""Which benchmarks there are."""

BENCHMARKS = {
    "speed": "kernel time per event against a square root and a division; calls, traces, threads, imports",
    "stress": "hostile random shots by class: does every one end, inside the table, without overlap?",
    "constants": "what each constant of the contact rule changes when it is ten times larger or smaller",
    "error_vs_time": "run time against error: this engine, time stepping, scipy's solve_ivp",
    "paper_claims": "the paper's operation counts and its comparison of quartic solvers, measured again",
    "contact_reference": "10^7 pairs: the contact solver's answers against a certified reference",
    "error_growth": "error against the number of collisions, by the arbitrary-precision engine",
    "scaling": "balls, threads, batch size; cost of an event where nothing is near",
    "savings": "counters of the work done and skipped, and what each saving is worth",
    "chained": "10^5 random shots, each from where the last one ended, through JSON: is any start refused?",
    "event_statistics": "coverage of the intervals of scores and ratings, error rates of the sequential test, by lot",
    "value": "weights of the value function behind the luck report, fitted to games of equal players",
    "value_bound": "how much of who wins a position any value function could explain",
    "luck": "the luck report: is the corrected score unbiased, and how much variance does it save?",
    "learning": "the learning environments: steps a second, one game at a time and many at once",
    "agents": "the shipped greedy against random: games won, called balls made, seconds a stroke",
    "search": "the shipped search in pairs of games against greedy and against itself without its parts",
    "search_habits": "what typically happens in games of search: the constants behind its values",
    "saturation": "times of strokes while one client keeps the batch endpoint busy, and while none does",
    "page": "the page with 30 live games: the browser's processor time and its longest frame",
    "search_breaks": "the study behind the break of `search`: random breaks, halved again and again",
    "tournaments": "events of in-process agents: games per second, in one process and with one and two workers",
    "load": "shots a second over HTTP with 1, 10, 100 and 500 games at once, next to a bare endpoint",
    "soak": "thousands of games through the SDK and HTTP: time-outs that nothing explains, and their upper bound",
}
"""Module in this package to one line about it."""
