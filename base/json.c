#include "base/json.h"

#include <inttypes.h>
#include <math.h>

static void start_item(struct json *j)
{
	if (j->after_key) {
		j->after_key = 0;
		return;
	}
	if (j->has_items)
		fputs(j->flat ? ", " : ",", j->out);
	if (!j->flat && j->depth)
		fprintf(j->out, "\n%*s", (int)j->depth * 2, "");
	j->has_items = 1;
}

void json_begin(struct json *j, char bracket)
{
	start_item(j);
	fputc(bracket, j->out);
	j->depth++;
	j->has_items = 0;
}

void json_end(struct json *j, char bracket)
{
	j->depth--;
	if (j->has_items && !j->flat)
		fprintf(j->out, "\n%*s", (int)j->depth * 2, "");
	fputc(bracket, j->out);
	j->has_items = 1;
}

/* Length of a well-formed UTF-8 character (RFC 3629: shortest form, no surrogates, up to U+10FFFF); 0: not one. */
static unsigned character(const unsigned char *p)
{
	const unsigned n = *p < 0x80 ? 1 : *p < 0xc2 ? 0 : *p < 0xe0 ? 2 : *p < 0xf0 ? 3 : *p < 0xf5 ? 4 : 0;

	for (unsigned i = 1; i < n; i++)
		if ((p[i] & 0xc0) != 0x80)
			return 0;
	if ((*p == 0xe0 && p[1] < 0xa0) || (*p == 0xed && p[1] > 0x9f) || (*p == 0xf0 && p[1] < 0x90) ||
	    (*p == 0xf4 && p[1] > 0x8f))
		return 0;
	return n;
}

/*
 * The code point of a character of up to three bytes that must be escaped for YAML readers, which take our JSON too:
 * controls, the byte order mark, ...
 */
static unsigned unprintable(const unsigned char *p, unsigned n)
{
	const unsigned number = n == 1 ? *p :
	                        n == 2 ? (*p & 0x1fu) << 6 | (p[1] & 0x3f) :
	                        n == 3 ? (*p & 0xfu) << 12 | (p[1] & 0x3fu) << 6 | (p[2] & 0x3f) :
	                                 0;

	return number < 0x20 || (number >= 0x7f && number < 0xa0) || number == 0xfeff || number >= 0xfffe ? number : 0;
}

/* Well-formed UTF-8 passes; any other byte is written as the code point of the same number. */
void json_string(struct json *j, const char *text)
{
	start_item(j);
	fputc('"', j->out);
	for (const unsigned char *p = (const unsigned char *)text; *p;) {
		unsigned n = character(p);

		if (*p == '"' || *p == '\\')
			fprintf(j->out, "\\%c", *p);
		else if (*p == '<') /* may be within a page's script */
			fputs("\\u003c", j->out);
		else if (!n || unprintable(p, n))
			fprintf(j->out, "\\u%04x", n ? unprintable(p, n) : *p);
		else
			fwrite(p, 1, n, j->out);
		p += n ? n : 1;
	}
	fputc('"', j->out);
}

void json_key(struct json *j, const char *name)
{
	json_string(j, name);
	fputs(": ", j->out);
	j->after_key = 1;
}

void json_uint(struct json *j, uint64_t value)
{
	start_item(j);
	fprintf(j->out, "%" PRIu64, value);
}

static void json_float(struct json *j, double value)
{
	start_item(j);
	if (isfinite(value))
		fprintf(j->out, "%.9g", value);
	else
		fputs("null", j->out);
}

void json_key_begin(struct json *j, const char *name, char bracket)
{
	json_key(j, name);
	json_begin(j, bracket);
}

void json_key_string(struct json *j, const char *name, const char *text)
{
	json_key(j, name);
	json_string(j, text);
}

void json_key_uint(struct json *j, const char *name, uint64_t value)
{
	json_key(j, name);
	json_uint(j, value);
}

void json_key_float(struct json *j, const char *name, double value)
{
	json_key(j, name);
	json_float(j, value);
}

void json_key_bool(struct json *j, const char *name, int value)
{
	json_key(j, name);
	start_item(j);
	fputs(value ? "true" : "false", j->out);
}

/* An array of numbers on one line. */
#define NUMBERS(j, name, n, write) \
	do { \
		json_key(j, name); \
		json_begin(j, '['); \
		(j)->flat = 1; \
		for (size_t i = 0; i < (n); i++) \
			write; \
		json_end(j, ']'); \
		(j)->flat = 0; \
	} while (0)

void json_key_floats(struct json *j, const char *name, const float *values, size_t n)
{
	NUMBERS(j, name, n, json_float(j, (double)values[i]));
}

void json_key_uints(struct json *j, const char *name, const uint32_t *values, size_t n)
{
	NUMBERS(j, name, n, json_uint(j, values[i]));
}

void json_key_ints(struct json *j, const char *name, const int32_t *values, size_t n)
{
	NUMBERS(j, name, n, json_float(j, values[i]));
}
