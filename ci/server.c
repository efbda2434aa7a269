/* Output for CI servers (GitHub Actions): the job summary, and error marks in the log. */
#include "ci/server.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

int server_reads_commands(void)
{
	const char *github = getenv("GITHUB_ACTIONS");

	return github && strcmp(github, "true") == 0;
}

void server_add_summary(const char *path)
{
	const char *shown = getenv("GITHUB_STEP_SUMMARY");
	FILE *from = shown && *shown ? fopen(path, "rb") : NULL, *to = from ? fopen(shown, "ab") : NULL;
	char text[4096];
	size_t n;

	while (to && (n = fread(text, 1, sizeof(text), from)) > 0)
		fwrite(text, 1, n, to);
	if (from && (!to || fclose(to)))
		err_warn(shown, "the summary cannot be added: %s", strerror(errno));
	if (from)
		fclose(from);
}

void server_mark_failure(const struct ci_program *program, const char *step, int code)
{
	if (server_reads_commands())
		printf("::error title=relume ci %s::%s failed with exit code %d; the log says why\n", program->name, step, code);
}
