#include "farm/program.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/err.h"
#include "base/memory.h"

extern char **environ;

int program_exists(const char *name)
{
	const char *path = getenv("PATH");
	char file[PATH_MAX];

	for (const char *p = path ? path : "/usr/bin:/bin"; *p;) {
		size_t n = strcspn(p, ":");

		if (snprintf(file, sizeof(file), "%.*s/%s", (int)n, p, name) < (int)sizeof(file) && access(file, X_OK) == 0)
			return 1;
		p += n + (p[n] == ':');
	}
	return 0;
}

static int read_all(int fd, char **out)
{
	size_t size = 0, room = 0;
	char *text = NULL;

	for (;;) {
		if (MEMORY_GROW(text, room, size + 4096)) {
			free(text);
			return ERR_SYSTEM;
		}
		ssize_t n = read(fd, text + size, room - size - 1);

		if (n < 0 && errno == EINTR)
			continue;
		if (n < 0) {
			free(text);
			return err_report(ERR_SYSTEM, NULL, "what a program says cannot be read: %s", strerror(errno));
		}
		if (n == 0)
			break;
		size += (size_t)n;
	}
	text[size] = '\0';
	*out = text;
	return 0;
}

int program_read(char *const *argv, int quiet, char **out)
{
	posix_spawn_file_actions_t actions;
	int pipe_fds[2], status = 0, err;
	pid_t pid;

	*out = NULL;
	if (pipe2(pipe_fds, O_CLOEXEC))
		return err_report(ERR_SYSTEM, argv[0], "%s", strerror(errno));
	posix_spawn_file_actions_init(&actions);
	posix_spawn_file_actions_adddup2(&actions, pipe_fds[1], STDOUT_FILENO);
	if (quiet)
		posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
	err = posix_spawnp(&pid, argv[0], &actions, NULL, argv, environ);
	posix_spawn_file_actions_destroy(&actions);
	close(pipe_fds[1]);
	if (err) {
		close(pipe_fds[0]);
		return err_report(ERR_SYSTEM, argv[0], "cannot start: %s", strerror(err));
	}
	err = read_all(pipe_fds[0], out);
	close(pipe_fds[0]);
	while (waitpid(pid, &status, 0) < 0 && errno == EINTR)
		;
	if (err)
		return err;
	return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}
