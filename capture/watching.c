#include "capture/watching.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capture/stats.h"

enum { MOST_DEEP = 32 }; /* levels of child processes */

/*
 * SEEN_* of the files that a process has mapped; 0 also if it has ended or belongs to another user. *mapped: whether
 * its loader is done.
 */
static unsigned read_maps(pid_t pid, int *mapped)
{
	char path[64], *line = NULL;
	size_t room = 0;
	unsigned seen = 0;
	FILE *file;

	snprintf(path, sizeof(path), "/proc/%d/maps", (int)pid);
	file = fopen(path, "re");
	*mapped = 0;
	while (file && getline(&line, &room, file) > 0) {
		char *name = strchr(line, '/');

		if (!name)
			continue;
		name[strcspn(name, "\n")] = '\0';
		seen |= stats_library(name);
		*mapped |= strstr(name, "/libc.so") != NULL;
	}
	free(line);
	if (file)
		fclose(file);
	return seen;
}

static void read_name(pid_t pid, char *out, size_t size)
{
	char path[64];
	FILE *file;

	snprintf(path, sizeof(path), "/proc/%d/comm", (int)pid);
	file = fopen(path, "re");
	if (!file || !fgets(out, (int)size, file))
		out[0] = '\0';
	out[strcspn(out, "\n")] = '\0';
	if (file)
		fclose(file);
}

/* 1 if a process is set-user-ID or set-group-ID (proc(5): readable by anyone, unlike its memory or file). */
static int has_rights(pid_t pid)
{
	char path[64], line[200];
	unsigned real, effective;
	int has = 0;
	FILE *file;

	snprintf(path, sizeof(path), "/proc/%d/status", (int)pid);
	file = fopen(path, "re");
	while (file && fgets(line, sizeof(line), file))
		if (sscanf(line, "Uid: %u %u", &real, &effective) == 2 || sscanf(line, "Gid: %u %u", &real, &effective) == 2)
			has |= real != effective;
	if (file)
		fclose(file);
	return has;
}

static void look_at(pid_t pid, struct watching *w)
{
	char path[64];
	int mapped;
	unsigned seen = read_maps(pid, &mapped);
	enum executable_kind kind;

	w->seen |= seen;
	if (seen & SEEN_RECORDER)
		return;
	if (has_rights(pid) && !w->stranger_rights) {
		w->stranger = pid;
		w->stranger_seen = seen;
		w->stranger_rights = 1;
		read_name(pid, w->name, sizeof(w->name));
	}
	if (w->stranger_rights)
		return;
	snprintf(path, sizeof(path), "/proc/%d/exe", (int)pid);
	kind = executable_kind(path);
	/* A process that is just starting does not count yet. */
	if ((kind != EXECUTABLE_STATIC && !mapped) || kind == EXECUTABLE_OTHER || (w->stranger && (w->stranger_seen || !seen)))
		return;
	w->stranger = pid;
	w->stranger_seen = seen;
	w->kind = kind;
	read_name(pid, w->name, sizeof(w->name));
}

static void look_below(pid_t pid, struct watching *w, int depth)
{
	char path[96];
	FILE *file;
	int child;

	look_at(pid, w);
	snprintf(path, sizeof(path), "/proc/%d/task/%d/children", (int)pid, (int)pid);
	file = depth < MOST_DEEP ? fopen(path, "re") : NULL;
	while (file && fscanf(file, "%d", &child) == 1)
		look_below(child, w, depth + 1);
	if (file)
		fclose(file);
}

void watching_look(pid_t root, struct watching *w)
{
	look_below(root, w, 0);
}
