"""Tables, migrations and transactions: everything the server remembers."""
