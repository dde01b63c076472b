"""What every service works with: context, time, periodic work, heartbeat, wake-ups, caches, warm-up."""
