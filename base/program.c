#include "base/program.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/err.h"
#include "base/memory.h"

extern char **environ;

static int is_executable(const char *path)
{
	struct stat info;

	return access(path, X_OK) == 0 && stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

int program_find(const char *name, char *out, size_t size)
{
	const char *path = strchr(name, '/') ? "" : getenv("PATH"), *end;

	for (path = path ? path : "/usr/bin:/bin"; path && *name; path = *end ? end + 1 : NULL) {
		end = strchrnul(path, ':');
		const int n = snprintf(out, size, "%.*s%s%s", (int)(end - path), path, end > path ? "/" : "", name);

		if (n < (int)size && is_executable(out))
			return 1;
	}
	return 0;
}

int program_exists(const char *name)
{
	char path[PATH_MAX];

	return program_find(name, path, sizeof(path));
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
			return err_report(ERR_SYSTEM, NULL, "cannot read the program's output: %s", strerror(errno));
		}
		if (n == 0)
			break;
		size += (size_t)n;
	}
	text[size] = '\0';
	*out = text;
	return 0;
}

static int wait_for(pid_t pid)
{
	int status = 0;

	while (waitpid(pid, &status, 0) < 0 && errno == EINTR)
		;
	return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

int program_read(char *const *argv, int quiet, char **out)
{
	posix_spawn_file_actions_t actions;
	int pipe_fds[2], code, err;
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
	code = wait_for(pid);
	return err ? err : code;
}

int program_run(char *const *argv)
{
	pid_t pid;
	int err;

	fflush(stdout);
	err = posix_spawnp(&pid, argv[0], NULL, NULL, argv, environ);
	if (err)
		return err_report(ERR_SYSTEM, argv[0], "cannot start: %s", strerror(err));
	return wait_for(pid);
}
