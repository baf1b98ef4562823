"""What papers printed beside what was simulated: verdicts, and what decides them."""
