#include "replay/glsl/parse/parse.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "replay/glsl/meaning/nodes.h"
#include "replay/glsl/parse/flatten.h"
#include "replay/glsl/parse/unit.h"

/* Everything that may longjmp is in this function, so that none of its variables are needed afterwards. */
static void read_all(struct parse *p, const char *const *texts, uint32_t n, struct glsl_tree *tree)
{
	p->root = parse_alloc(p, sizeof(*p->root));
	for (uint32_t i = 0; i < n; i++)
		parse_unit(p, texts[i]);
	parse_flatten(p, tree);
}

int glsl_parse(const char *const *texts, uint32_t n, enum glsl_stage stage, bool once, struct glsl_tree *tree,
               char *message, const char **why)
{
	struct parse *p = calloc(1, sizeof(*p));
	int err;

	*why = NULL;
	if (!p)
		return err_report(ERR_SYSTEM, NULL, "out of memory for a shader");
	p->stage = stage;
	p->products_once = once;
	if (!setjmp(p->stop))
		read_all(p, texts, n, tree);
	if (p->why == p->message)
		memcpy(message, p->message, GLSL_MESSAGE);
	*why = p->why == p->message ? message : p->why;
	err = p->err;
	arena_free(&p->arena);
	free(p);
	return err;
}
