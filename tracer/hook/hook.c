#include "tracer/hook/hook.h"

#include <ctype.h>
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/plural.h"

#define MOST_BYTES (1u << 20)

#define HOOK_STAGE_NAME(name, function) #function,
const char *const hook_stage_names[N_HOOK_STAGES] = { HOOK_STAGES(HOOK_STAGE_NAME) };
#define HOOK_STAGE_MACRO(name, function) "HOOK_" #name,
static const char *const stage_macros[N_HOOK_STAGES] = { HOOK_STAGES(HOOK_STAGE_MACRO) };
const char *const hook_type_names[N_HOOK_TYPES] = { "float", "int", "color" };

/* --- Text -------------------------------------------------------------------------------------------------------- */

/* Copy the source with comments blanked and line breaks kept. */
static char *without_comments(const char *text)
{
	char *out = strdup(text);

	for (char *at = out; at && *at; at++) {
		const char *end = at[0] == '/' && at[1] == '/' ? strchr(at, '\n') :
		                  at[0] == '/' && at[1] == '*' ? strstr(at + 2, "*/") :
		                                                 at;

		if (end == at)
			continue;
		for (end = end ? end + (at[1] == '*' ? 2 : 0) : at + strlen(at); at < end; at++)
			*at = *at == '\n' ? '\n' : ' ';
		at--;
	}
	return out;
}

static int is_name(char c)
{
	return isalnum((unsigned char)c) || c == '_';
}

/* Is a function of this name defined? Looks for the name, its parameters and a body. */
static int defines(const char *text, const char *name)
{
	const size_t length = strlen(name);

	for (const char *at = text; (at = strstr(at, name)); at += length) {
		const char *next = at + length + strspn(at + length, " \t\n");
		int depth = 0;

		if ((at > text && is_name(at[-1])) || is_name(at[length]) || *next != '(')
			continue;
		for (; *next; next++) {
			depth += (*next == '(') - (*next == ')');
			if (depth == 0)
				break;
		}
		if (*next && next[1 + strspn(next + 1, " \t\n")] == '{')
			return 1;
	}
	return 0;
}

static int read_text(const char *path, char **out)
{
	FILE *file = fopen(path, "rb");
	size_t n;
	int failed;

	*out = file ? calloc(1, MOST_BYTES + 1) : NULL;
	if (!file)
		return err_report(ERR_INPUT, path, "%s", strerror(errno));
	n = *out ? fread(*out, 1, MOST_BYTES, file) : 0;
	failed = ferror(file) ? errno : 0;
	fclose(file);
	if (!*out)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (failed)
		return err_report(ERR_SYSTEM, path, "cannot be read: %s", strerror(failed));
	if (n == MOST_BYTES || strlen(*out) != n)
		return err_report(ERR_INPUT, path, "is no text of less than a megabyte");
	return 0;
}

/* --- Parameters -------------------------------------------------------------------------------------------------- */

static int is_known(const struct hook *h, const char *name)
{
	for (unsigned i = 0; i < h->n_parameters; i++)
		if (strcmp(h->parameters[i].name, name) == 0)
			return 1;
	return 0;
}

/* Parse the text after "#pragma relume". */
static int read_parameter(struct hook *h, unsigned line, const char *text)
{
	struct hook_parameter *p = &h->parameters[h->n_parameters];
	char type[16] = "", *end = NULL;
	int n = 0, i = 0;

	if (h->n_parameters == HOOK_MAX_PARAMETERS)
		return err_report(ERR_INPUT, h->path, "line %u: more than %d parameters", line, HOOK_MAX_PARAMETERS);
	if (sscanf(text, " parameter %15[a-z] %47[A-Za-z0-9_] = %n", type, p->name, &n) != 2 || n == 0 ||
	    isdigit((unsigned char)p->name[0]))
		return err_report(
			ERR_INPUT, h->path,
			"line %u: a parameter is declared as '#pragma relume parameter float NAME = VALUE', of "
			"types float, int and color",
			line);
	while (i < N_HOOK_TYPES && strcmp(hook_type_names[i], type) != 0)
		i++;
	if (i == N_HOOK_TYPES)
		return err_report(ERR_INPUT, h->path,
		                  "line %u: there is no type %s of parameters; there are float, int and color", line,
		                  type);
	if (is_known(h, p->name))
		return err_report(ERR_INPUT, h->path, "line %u: parameter %s is declared twice", line, p->name);
	p->type = (enum hook_type)i;
	p->words = p->type == HOOK_COLOR ? 3 : 1;
	text += n;
	for (unsigned k = 0; k < p->words; k++, text = end) {
		p->initial[k] = strtof(text, &end);
		if (end == text)
			return err_report(ERR_INPUT, h->path, "line %u: parameter %s takes %u number%s", line, p->name,
			                  p->words, plural(p->words));
	}
	if (text[strspn(text, " \t\r")] != '\n' && text[strspn(text, " \t\r")] != '\0')
		return err_report(ERR_INPUT, h->path, "line %u: parameter %s takes %u number%s, and nothing behind",
		                  line, p->name, p->words, plural(p->words));
	h->words += p->words;
	h->n_parameters++;
	return 0;
}

static int read_parameters(struct hook *h, const char *text)
{
	unsigned line = 1;
	int err = 0;

	for (const char *at = text; at && *at && !err; line++) {
		int n = 0;

		if (sscanf(at, "#pragma relume%n", &n) == 0 && n && !is_name(at[n]))
			err = read_parameter(h, line, at + n);
		at = strchr(at, '\n');
		at += at != NULL;
	}
	return err;
}

void hook_start_row(const struct hook *hook, float *row)
{
	for (unsigned i = 0; i < hook->n_parameters; row += hook->parameters[i++].words)
		memcpy(row, hook->parameters[i].initial, hook->parameters[i].words * sizeof(*row));
}

void hook_fill_row(const struct hook *hook, const struct scene_parameter *list, uint32_t n, float *row)
{
	for (unsigned i = 0; i < hook->n_parameters; row += hook->parameters[i++].words)
		for (uint32_t k = 0; k < n; k++)
			if (strcmp(list[k].name, hook->parameters[i].name) == 0)
				memcpy(row, list[k].value, hook->parameters[i].words * sizeof(*row));
}

int hook_check_parameters(const struct hook *hook, const struct scene_parameter *list, uint32_t n)
{
	for (uint32_t k = 0; k < n; k++) {
		const struct hook_parameter *p = hook->parameters;

		while (p < hook->parameters + hook->n_parameters && strcmp(p->name, list[k].name) != 0)
			p++;
		if (p == hook->parameters + hook->n_parameters)
			return err_report(ERR_INPUT, hook->path, "has no parameter %s, which the rules set", list[k].name);
		if (p->words != list[k].count)
			return err_report(ERR_INPUT, hook->path, "parameter %s takes %u number%s; the rules give %u", p->name, p->words,
			                  plural(p->words), list[k].count);
	}
	return 0;
}

/* --- Declarations ------------------------------------------------------------------------------------------------ */

/* Write the struct of parameters and the function that reads it from a row. */
static void declare_parameters(const struct hook *h, FILE *out)
{
	static const char *const types[N_HOOK_TYPES] = { "float", "int", "float4" };
	unsigned at = 0;

	fprintf(out, "struct relume_parameters {\n");
	for (unsigned i = 0; i < h->n_parameters; i++)
		fprintf(out, "\t%s %s;\n", types[h->parameters[i].type], h->parameters[i].name);
	fprintf(out, "\tint none;\n};\nstatic inline struct relume_parameters hook_parameters(__global const float *row)\n{\n"
	        "\tstruct relume_parameters p;\n\n\tp.none = 0;\n");
	for (unsigned i = 0; i < h->n_parameters; at += h->parameters[i++].words)
		fprintf(out, h->parameters[i].type == HOOK_COLOR ? "\tp.%s = (float4)(row[%u], row[%u], row[%u], 0.0f);\n" :
		        h->parameters[i].type == HOOK_INT ? "\tp.%s = (int)row[%u];\n" : "\tp.%s = row[%u];\n",
		        h->parameters[i].name, at, at + 1, at + 2);
	fprintf(out, "\treturn p;\n}\n");
}

static int declare(struct hook *h)
{
	size_t n = 0;
	FILE *out = open_memstream(&h->declarations, &n);

	if (!out)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (int i = 0; i < N_HOOK_STAGES; i++)
		if (h->stages >> i & 1)
			fprintf(out, "#define %s\n", stage_macros[i]);
	declare_parameters(h, out);
	return fclose(out) ? err_report(ERR_SYSTEM, NULL, "out of memory") : 0;
}

int hook_make(const char *path, const char *own, struct hook **out)
{
	struct hook *h = calloc(1, sizeof(*h));
	char *bare = NULL;
	int err = h ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	*out = h;
	if (!err) {
		h->path = path;
		bare = without_comments(own);
		if (!bare || asprintf(&h->text, "\n#line 1 \"%s\"\n%s\n", path, own) < 0)
			err = err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	for (int i = 0; i < N_HOOK_STAGES && !err; i++)
		h->stages |= (unsigned)defines(bare, hook_stage_names[i]) << i;
	if (!err && !h->stages)
		err = err_report(
			ERR_INPUT, path,
			"defines none of the functions of a hook: ray_generation, bounds and intersection, any_hit, "
			"closest_hit, miss, light");
	if (!err && !(h->stages & HOOK_BOUNDS) != !(h->stages & HOOK_INTERSECTION))
		err = err_report(
			ERR_INPUT, path, "defines %s without %s: there must be both",
			hook_stage_names[h->stages & HOOK_BOUNDS ? HOOK_NUMBER_BOUNDS : HOOK_NUMBER_INTERSECTION],
			hook_stage_names[h->stages & HOOK_BOUNDS ? HOOK_NUMBER_INTERSECTION : HOOK_NUMBER_BOUNDS]);
	if (!err)
		h->asks_boxes = strstr(bare, "relume_box_tests") != NULL;
	if (!err)
		err = read_parameters(h, bare);
	if (!err)
		err = declare(h);
	free(bare);
	if (err)
		hook_free(out);
	return err;
}

int hook_load(const char *path, struct hook **out)
{
	char *own = NULL;
	int err = read_text(path, &own);

	*out = NULL;
	if (!err)
		err = hook_make(path, own, out);
	free(own);
	return err;
}

void hook_free(struct hook **hook)
{
	struct hook *h = *hook;

	*hook = NULL;
	if (!h)
		return;
	free(h->text);
	free(h->declarations);
	if (h->library)
		dlclose(h->library);
	free(h);
}
