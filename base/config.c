#include "base/config.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"

/* libcyaml's message about the first error, and the first line number in its backtrace. */
struct complaint {
	char text[256];
	int line;
};

static void take_complaint(cyaml_log_t level, void *context, const char *fmt, va_list args)
{
	struct complaint *c = context;
	char text[256], *at;
	int line;

	(void)level;
	vsnprintf(text, sizeof(text), fmt, args);
	text[strcspn(text, "\n")] = '\0';
	at = strstr(text, "line: ");
	if (at && sscanf(at, "line: %d", &line) == 1) {
		if (!c->line)
			c->line = line;
		return;
	}
	if (!c->text[0] && !strstr(text, "Backtrace"))
		snprintf(c->text, sizeof(c->text), "%s", strncmp(text, "Load: ", 6) == 0 ? text + 6 : text);
}

static cyaml_config_t make_config(struct complaint *complaint)
{
	return (cyaml_config_t){ .log_fn = complaint ? take_complaint : NULL, .log_ctx = complaint, .mem_fn = cyaml_mem,
	                         .log_level = CYAML_LOG_ERROR };
}

static int read_all(const char *path, char **out, size_t *n)
{
	FILE *f = fopen(path, "rb");
	char *data = NULL;
	size_t used = 0, size = 0;

	if (!f)
		return err_report(ERR_INPUT, path, "%s", strerror(errno));
	for (;;) {
		if (MEMORY_GROW(data, size, used + 4096)) {
			free(data);
			fclose(f);
			return ERR_SYSTEM;
		}
		size_t got = fread(data + used, 1, size - used, f);

		used += got;
		if (got == 0)
			break;
	}
	if (ferror(f)) {
		free(data);
		fclose(f);
		return err_report(ERR_INPUT, path, "%s", strerror(errno));
	}
	fclose(f);
	*out = data;
	*n = used;
	return 0;
}

/**
 * libcyaml names the line it read last, which for a key is an earlier one. If the message names a key, search for it
 * from that line on.
 */
static int line_of_key(const char *text, const char *end, const struct complaint *c)
{
	const char *key = strstr(c->text, "key: ") ? strstr(c->text, "key: ") + 5
		: strstr(c->text, "already seen: ") ? strstr(c->text, "already seen: ") + 14 : NULL;
	const size_t n = key ? strlen(key) : 0;
	int line = 1, first = c->line + (key && strstr(c->text, "already seen") ? 1 : 0);

	for (const char *at = text; key && at + n < end; at++) {
		if (line >= first && memcmp(at, key, n) == 0 && at[n] == ':')
			return line;
		line += *at == '\n';
	}
	return c->line;
}

int config_parse(const char *name, const char *text, size_t n, const cyaml_schema_value_t *schema, void **out)
{
	struct complaint complaint = { "", 0 };
	const cyaml_config_t config = make_config(&complaint);
	cyaml_err_t code;

	*out = NULL;
	code = cyaml_load_data((const uint8_t *)text, n, &config, schema, out, NULL);
	complaint.line = code == CYAML_OK ? 0 : line_of_key(text, text + n, &complaint);
	if (code == CYAML_OK && *out)
		return 0;
	if (code == CYAML_OK)
		return err_report(ERR_INPUT, name, "the file is empty");
	if (code == CYAML_ERR_OOM)
		return err_report(ERR_SYSTEM, name, "out of memory");
	if (complaint.line)
		return err_report(ERR_INPUT, name, "line %d: %s", complaint.line,
		                  complaint.text[0] ? complaint.text : cyaml_strerror(code));
	return err_report(ERR_INPUT, name, "%s", complaint.text[0] ? complaint.text : cyaml_strerror(code));
}

int config_load(const char *path, const cyaml_schema_value_t *schema, void **out)
{
	char *text = NULL;
	size_t n = 0;
	int err = read_all(path, &text, &n);

	if (err)
		return err;
	err = config_parse(path, text, n, schema, out);
	free(text);
	return err;
}

void config_free(const cyaml_schema_value_t *schema, void *data)
{
	const cyaml_config_t config = make_config(NULL);

	if (data)
		cyaml_free(&config, schema, data, 0);
}
