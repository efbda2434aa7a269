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

/* Well-formed UTF-8 passes; any other byte is shown as the character of its number. */
void json_string(struct json *j, const char *text)
{
	start_item(j);
	fputc('"', j->out);
	for (const unsigned char *p = (const unsigned char *)text; *p; p++) {
		unsigned n = *p < 0x80 ? 0 : (*p & 0xe0) == 0xc0 ? 1 : (*p & 0xf0) == 0xe0 ? 2 : (*p & 0xf8) == 0xf0 ? 3 : 9;
		unsigned k = 0;
		while (k < n && (p[k + 1] & 0xc0) == 0x80)
			k++;
		if (*p == '"' || *p == '\\')
			fprintf(j->out, "\\%c", *p);
		else if (*p < 0x20 || (*p >= 0x80 && k < n))
			fprintf(j->out, "\\u%04x", *p);
		else
			for (fputc(*p, j->out); n; n--)
				fputc(*++p, j->out);
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
