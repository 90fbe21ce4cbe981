"""BehaviorTree.CPP v4 XML: missions made of it, and it of missions."""
