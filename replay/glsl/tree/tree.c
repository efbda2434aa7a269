#include "replay/glsl/tree/tree.h"

#include <stdlib.h>
#include <string.h>

void glsl_tree_free(struct glsl_tree *tree)
{
	free(tree->types);
	free(tree->members);
	free(tree->symbols);
	free(tree->nodes);
	free(tree->functions);
	free(tree->children);
	free(tree->numbers);
	free(tree->names);
	memset(tree, 0, sizeof(*tree));
}
