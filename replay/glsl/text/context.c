#include "replay/glsl/text/context.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/err.h"
#include "replay/glsl/text/keywords.h"

#define MAX_BYTES ((size_t)256 << 20)

void *parse_alloc(struct parse *p, size_t n)
{
	void *at;

	p->bytes += n;
	if (p->bytes > MAX_BYTES)
		parse_refuse(p, "a shader takes too much memory");
	at = arena_alloc(&p->arena, n ? n : 1);
	if (!at) {
		p->err = err_report(ERR_SYSTEM, NULL, "out of memory for a shader");
		longjmp(p->stop, 1);
	}
	return memset(at, 0, n);
}

void *parse_grow(struct parse *p, void *items, uint32_t n, uint32_t *room, size_t item_bytes)
{
	void *moved;

	if (n < *room)
		return items;
	*room = *room ? 2 * *room : 8;
	moved = parse_alloc(p, *room * item_bytes);
	if (n)
		memcpy(moved, items, n * item_bytes);
	return moved;
}

struct parse_name *parse_name(struct parse *p, const char *text, uint32_t n)
{
	uint32_t hash = 2166136261u;
	struct parse_name *name;
	char *copy;

	for (uint32_t i = 0; i < n; i++)
		hash = (hash ^ (unsigned char)text[i]) * 16777619u;
	hash = (hash ^ hash >> 15) % PARSE_NAMES;
	for (name = p->names[hash]; name; name = name->next)
		if (name->n == n && memcmp(name->text, text, n) == 0)
			return name;
	name = parse_alloc(p, sizeof(*name));
	copy = parse_alloc(p, n + 1);
	memcpy(copy, text, n);
	name->text = copy;
	name->n = n;
	name->keyword = parse_keyword_of(copy);
	name->next = p->names[hash];
	p->names[hash] = name;
	return name;
}

_Noreturn void parse_refuse(struct parse *p, const char *why)
{
	p->why = why;
	longjmp(p->stop, 1);
}

_Noreturn static void end(struct parse *p, size_t n, const char *format, va_list arguments)
{
	vsnprintf(p->message + n, sizeof(p->message) - n, format, arguments);
	p->why = p->message;
	longjmp(p->stop, 1);
}

_Noreturn void parse_error(struct parse *p, const char *format, ...)
{
	const int n = snprintf(p->message, sizeof(p->message), "a shader does not compile here: line %u: ", p->line);
	va_list arguments;

	va_start(arguments, format);
	end(p, (size_t)n, format, arguments);
}

_Noreturn void parse_link_error(struct parse *p, const char *format, ...)
{
	const int n = snprintf(p->message, sizeof(p->message), "a program's shaders do not link here: ");
	va_list arguments;

	va_start(arguments, format);
	end(p, (size_t)n, format, arguments);
}

void parse_enter(struct parse *p)
{
	if (++p->depth > PARSE_MAX_NESTED)
		parse_refuse(p, "a shader is nested too deeply");
}

void parse_leave(struct parse *p)
{
	p->depth--;
}

bool parse_has(const struct parse *p, uint32_t version, uint32_t extensions)
{
	return p->version >= version || p->is_prelude || p->extensions & extensions;
}
