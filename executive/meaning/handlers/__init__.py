"""What goals take, as steps of skills: a file a family of goals."""
