//! Two triangulated surfaces over each other: exact volumes over their common refinement.
