/* The front end: parses the texts of a stage into a tree. */
#pragma once

#include <stdbool.h>

#include "replay/glsl/tree/tree.h"

/**
 * Parse the texts of a stage.
 * @param texts    [n], one per shader object
 * @param once     (A B C) v becomes (A B) (C v), not A (B (C v)): scene/mesa.h, SCENE_MESA_PRODUCTS_ONCE
 * @param tree     all zero; filled in, and to be freed with glsl_tree_free whatever is returned
 * @param message  [GLSL_MESSAGE] storage for a reason
 * @param why      receives NULL, or why the shader cannot be run: a static string, or `message`
 * @return 0, also if *why is set, or ERR_SYSTEM (reported)
 */
int glsl_parse(const char *const *texts, uint32_t n, enum glsl_stage stage, bool once, struct glsl_tree *tree,
               char *message, const char **why);
