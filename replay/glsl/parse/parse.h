/* The front end: texts of a stage become a tree. */
#pragma once

#include <stdbool.h>

#include "replay/glsl/tree/tree.h"

/**
 * Parse the texts of a stage.
 * @param texts    n of them, each a shader object's
 * @param once     (A B C) v is (A B) (C v), and not A (B (C v)): scene/mesa.h, SCENE_MESA_PRODUCTS_ONCE
 * @param tree     all zero; filled, and to be freed with glsl_tree_free whatever is returned
 * @param message  [GLSL_MESSAGE] room for a reason
 * @param why      receives NULL, or what stands in the way: a static string, or `message`
 * @return 0, also where *why is set, or ERR_SYSTEM (reported)
 */
int glsl_parse(const char *const *texts, uint32_t n, enum glsl_stage stage, bool once, struct glsl_tree *tree,
               char *message, const char **why);
