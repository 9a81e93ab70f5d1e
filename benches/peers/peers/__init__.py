"""One module for each peer, with `forms(task, variant, folder)`: every form worth trying, ready to be called."""
