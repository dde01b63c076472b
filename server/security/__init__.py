"""Who is asking, and what is let in at all."""
