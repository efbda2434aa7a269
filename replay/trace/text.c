#include "replay/trace/text.h"

#include <inttypes.h>

#include "replay/trace/reader.h"

static void print_string(FILE *out, const char *s, uint64_t n)
{
	fputc('"', out);
	for (uint64_t i = 0; i < n; i++) {
		unsigned char ch = (unsigned char)s[i];
		if (ch == '"' || ch == '\\')
			fprintf(out, "\\%c", ch);
		else if (ch == '\n')
			fputs("\\n", out);
		else if (ch == '\r')
			fputs("\\r", out);
		else if (ch == '\t')
			fputs("\\t", out);
		else if (ch < 0x20 || ch == 0x7f)
			fprintf(out, "\\x%02x", ch);
		else
			fputc(ch, out);
	}
	fputc('"', out);
}

static void print_bitmask(FILE *out, const struct trace_value *v)
{
	const struct trace_values_sig *sig = v->sig;
	uint64_t left = v->u;
	int first = 1;

	for (uint32_t i = 0; i < sig->n; i++) {
		if (sig->values[i] == 0 ? v->u != 0 || !first : (left & sig->values[i]) != sig->values[i])
			continue;
		fprintf(out, "%s%s", first ? "" : " | ", sig->names[i]);
		left &= ~sig->values[i];
		first = 0;
	}
	if (left || first)
		fprintf(out, left || v->u ? "%s0x%" PRIx64 : "%s%" PRIu64, first ? "" : " | ", left);
}

void text_value(FILE *out, const struct trace_value *v)
{
	const struct trace_struct_sig *s;
	const char *name;

	switch (v->type) {
	case TRACE_NONE: fputc('?', out); break;
	case TRACE_NULL: fputs("NULL", out); break;
	case TRACE_FALSE: case TRACE_TRUE: fputs(v->type == TRACE_TRUE ? "true" : "false", out); break;
	case TRACE_SINT: fprintf(out, "%" PRId64, v->i); break;
	case TRACE_UINT: fprintf(out, "%" PRIu64, v->u); break;
	case TRACE_FLOAT: fprintf(out, "%.9g", (double)v->f); break;
	case TRACE_DOUBLE: fprintf(out, "%.17g", v->d); break;
	case TRACE_STRING: print_string(out, v->str, v->count); break;
	case TRACE_BLOB: fprintf(out, "blob(%" PRIu64 ")", v->count); break;
	case TRACE_ENUM:
		name = trace_enum_name(v);
		if (name)
			fputs(name, out);
		else
			fprintf(out, "%" PRId64, v->i);
		break;
	case TRACE_BITMASK:
		print_bitmask(out, v);
		break;
	case TRACE_ARRAY:
		fputc('{', out);
		for (uint64_t i = 0; i < v->count; i++) {
			fputs(i ? ", " : "", out);
			text_value(out, &v->items[i]);
		}
		fputc('}', out);
		break;
	case TRACE_STRUCT:
		s = v->sig;
		fputc('{', out);
		for (uint64_t i = 0; i < v->count; i++) {
			fprintf(out, "%s%s = ", i ? ", " : "", s->members[i]);
			text_value(out, &v->items[i]);
		}
		fputc('}', out);
		break;
	case TRACE_OPAQUE:
		fprintf(out, "0x%" PRIx64, v->u);
		break;
	case TRACE_REPR:
		text_value(out, &v->items[0]);
		break;
	default:
		fprintf(out, "wide(%" PRIu64 ")", v->count);
	}
}

void text_call(FILE *out, const struct call *c)
{
	fprintf(out, "%s(", c->sig->name);
	for (uint32_t i = 0; i < c->n_args; i++) {
		fprintf(out, "%s%s%s", i ? ", " : "", i < c->sig->n_args ? c->sig->arg_names[i] : "",
		        i < c->sig->n_args ? " = " : "");
		text_value(out, &c->args[i]);
	}
	fputc(')', out);
	if (c->ret.type != TRACE_NONE) {
		fputs(" = ", out);
		text_value(out, &c->ret);
	}
	if (c->flags & CALL_FAKE)
		fputs(" // fake", out);
	if (c->incomplete)
		fputs(" // incomplete", out);
}
