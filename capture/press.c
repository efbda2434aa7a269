#include "capture/press.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/options.h"
#include "capture/key.h"

enum { KEY_PRESS = 2, KEY_RELEASE = 3 }; /* events of the X protocol */
enum { MAX_NAME_BYTES = 64, MAX_FRAME = 1000000000 };

struct event {
	uint64_t frame;
	size_t order; /* as typed */
	int type;
	struct key_code key;
};

int press_take(const struct options_row *row, const char *text, void *out)
{
	struct press_list *keys = out;

	(void)row;
	if (MEMORY_GROW(keys->texts, keys->room, keys->n + 1))
		return ERR_SYSTEM;
	keys->texts[keys->n++] = text;
	return 0;
}

void press_free(struct press_list *keys)
{
	free(keys->texts);
	*keys = (struct press_list){ 0 };
}

/* "Control+Alt+": what precedes the key's name. @return where the name begins */
static const char *read_modifiers(const char *text, unsigned *state)
{
	static const struct {
		const char *name;
		unsigned state;
	} modifiers[] = { { "Shift+", KEY_SHIFT }, { "Control+", KEY_CONTROL }, { "Alt+", KEY_ALT } };

	for (size_t i = 0; i < sizeof(modifiers) / sizeof(modifiers[0]); i++)
		if (strncmp(text, modifiers[i].name, strlen(modifiers[i].name)) == 0) {
			*state |= modifiers[i].state;
			return read_modifiers(text + strlen(modifiers[i].name), state);
		}
	return text;
}

/* "20" or "20-30". @return 1; 0: no frames */
static int read_frames(const char *text, uint64_t *first, uint64_t *last)
{
	char *end;

	if (!isdigit((unsigned char)*text))
		return 0;
	*first = *last = strtoull(text, &end, 10);
	if (*end == '-' && isdigit((unsigned char)end[1]))
		*last = strtoull(end + 1, &end, 10);
	return !*end && *first >= 1 && *last >= *first && *last <= MAX_FRAME;
}

/* A key's press and its release. */
static int read_key(const char *text, uint64_t quit_after, struct event out[2])
{
	unsigned state = 0;
	const char *name = read_modifiers(text, &state), *at = strrchr(name, '@');
	uint64_t first, last;
	char key[MAX_NAME_BYTES];
	int err;

	if (!at || at == name || at - name >= MAX_NAME_BYTES || !read_frames(at + 1, &first, &last))
		return err_report(ERR_USAGE, NULL, "--press takes a key and the frame that is the first to show it, from 1 on, "
		                  "as in space@10, Left@20-30 or Control+s@5, not '%s'", text);
	if (quit_after && first >= quit_after)
		return err_report(ERR_USAGE, NULL, "--press %s: the program ends after %" PRIu64 " frames, counted "
		                  "from frame 0", text, quit_after);
	snprintf(key, sizeof(key), "%.*s", (int)(at - name), name);
	err = key_find("--press", key, &out[0].key);
	out[0].key.state |= state;
	out[0].frame = first;
	out[0].type = KEY_PRESS;
	out[1] = out[0];
	out[1].frame = strchr(at, '-') ? last + 1 : first;
	out[1].type = KEY_RELEASE;
	return err;
}

static int compare(const void *a, const void *b)
{
	const struct event *x = a, *y = b;

	return x->frame != y->frame ? (x->frame < y->frame ? -1 : 1) : (x->order > y->order) - (x->order < y->order);
}

int press_plan(const struct press_list *keys, uint64_t quit_after, char **out)
{
	struct event *events = calloc(2 * keys->n + 1, sizeof(*events));
	size_t size;
	FILE *list = keys->n ? open_memstream(out, &size) : NULL;
	int err = events && (list || !keys->n) ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (size_t i = 0; !err && i < keys->n; i++) {
		err = read_key(keys->texts[i], quit_after, &events[2 * i]);
		events[2 * i].order = 2 * i;
		events[2 * i + 1].order = 2 * i + 1;
	}
	if (!err)
		qsort(events, 2 * keys->n, sizeof(*events), compare);
	for (size_t i = 0; list && !err && i < 2 * keys->n; i++)
		fprintf(list, "%s%" PRIu64 ":%d:%d:%u", i ? " " : "", events[i].frame, events[i].type, events[i].key.code,
		        events[i].key.state);
	if (list && fclose(list) && !err)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	free(events);
	return err;
}
