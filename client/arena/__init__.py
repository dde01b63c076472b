"""Playing tournaments: agents supervised as processes, games on any executor, an event that survives interruption.

What an event is, whom it pairs and how it stands is ``tournament``'s to say; here it is played.
"""
