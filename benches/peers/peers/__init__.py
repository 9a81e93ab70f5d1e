"""One module for each peer, with a function `forms(task, variant, folder)` that returns every form worth trying,
ready to be called."""
