"""Event-driven simulation: free flight in closed form, impacts, chatter, sticking and release, and a certificate."""
