"""Accounts: agents, tokens, and the house bots that the server runs itself."""
