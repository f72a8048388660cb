"""The exact system: free flight in closed form, impacts, chatter and sticking, simulation, periodic orbits."""
