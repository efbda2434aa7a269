#include "tracer/image/foreign.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/bytes.h"
#include "base/confine.h"
#include "base/err.h"
#include "tracer/image/oiio.h"

#define MOST_PIXELS ((uint64_t)1 << 28) /* same limit as oiio_read */
#define MOST_SECONDS 60                 /* most processor time for the largest picture */
#define MOST_MEMORY ((rlim_t)1 << 33)

/* The server: a process with OpenImageIO loaded and a single thread, which forks for each picture. channel is -1 until
 * it is started. */
static struct {
	pthread_mutex_t lock;
	int channel;
} server = { PTHREAD_MUTEX_INITIALIZER, -1 };

/* --- In the picture's process ------------------------------------------------------------------------------------ */

/* Write the head, which precedes a picture's planes. */
static void put_head(struct bytes *head, const struct image *img)
{
	bytes_put_u64(head, img->width);
	bytes_put_u64(head, img->height);
	bytes_put_u64(head, img->n_channels);
	for (size_t i = 0; i < img->n_channels; i++) {
		bytes_put_text(head, img->channels[i].name);
		bytes_put_u64(head, (uint64_t)img->channels[i].full_float);
	}
	bytes_put_u64(head, img->n_attributes);
	for (size_t i = 0; i < img->n_attributes; i++) {
		bytes_put_text(head, img->attributes[i].name);
		bytes_put_text(head, img->attributes[i].text);
	}
}

static void limit(int what, rlim_t most)
{
	const struct rlimit both = { most, most };

	setrlimit(what, &both);
}

/* Write the answer to a pipe: the result of reading, the size of the head, the head, the planes. */
static void answer(const char *path, int pipe)
{
	const struct confine_file file = { path, CONFINE_READS };
	struct image img = { 0 };
	struct bytes head = { 0 };
	FILE *out = fdopen(pipe, "wb");
	int64_t err;

	if (confine_to(&file, 1, CONFINE_READER))
		return;
	limit(RLIMIT_CPU, MOST_SECONDS);
	limit(RLIMIT_CORE, 0);
#ifndef __SANITIZE_ADDRESS__ /* AddressSanitizer maps terabytes */
	limit(RLIMIT_DATA, MOST_MEMORY);
#endif
	err = oiio_read(&img, path);
	put_head(&head, &img);
	if (!out || head.failed)
		return;
	fwrite(&err, sizeof(err), 1, out);
	fwrite(&head.n, sizeof(head.n), 1, out);
	fwrite(head.data, 1, head.n, out);
	for (size_t i = 0; i < img.n_channels; i++)
		fwrite(img.channels[i].values, sizeof(float), (size_t)img.width * img.height, out);
	fflush(out);
}

/* --- In the server ----------------------------------------------------------------------------------------------- */

/* Receive the next request: a path, and the pipe for its picture. @return 0: no more requests */
static int take_request(int channel, char path[PATH_MAX], int *pipe)
{
	union {
		struct cmsghdr head;
		char room[CMSG_SPACE(sizeof(int))];
	} control;
	struct iovec text = { path, PATH_MAX - 1 };
	struct msghdr message = {
		.msg_iov = &text, .msg_iovlen = 1, .msg_control = &control, .msg_controllen = sizeof(control)
	};
	ssize_t n;

	do
		n = recvmsg(channel, &message, MSG_CMSG_CLOEXEC);
	while (n < 0 && errno == EINTR);
	if (n <= 0 || !CMSG_FIRSTHDR(&message))
		return 0;
	path[n] = '\0';
	memcpy(pipe, CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof(*pipe));
	return 1;
}

/* The server's loop: read each requested picture in a child. Does not return. */
static void serve(int channel)
{
	char path[PATH_MAX];
	int pipe;

	/* Close the command's files here, including pipes to its other children. */
	dup2(channel, STDERR_FILENO + 1);
	close_range(STDERR_FILENO + 2, ~0u, 0);
	signal(SIGCHLD, SIG_IGN);
	signal(SIGPIPE, SIG_IGN);
	signal(SIGINT, SIG_DFL);
	signal(SIGTERM, SIG_DFL);
	while (take_request(STDERR_FILENO + 1, path, &pipe)) {
		if (fork() == 0) {
			prctl(PR_SET_PDEATHSIG, SIGKILL); /* end with the command, whose end closes the channel */
			close(STDERR_FILENO + 1);
			answer(path, pipe);
			_exit(0);
		}
		close(pipe);
	}
	_exit(0);
}

/* --- In the command ---------------------------------------------------------------------------------------------- */

/* Start the server. server.lock is held. @return 0 or ERR_SYSTEM (reported) */
static int start(void)
{
	int ends[2];
	pid_t process;

	if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends))
		return err_report(ERR_SYSTEM, NULL, "no process to read pictures in: %s", strerror(errno));
	process = oiio_fork();
	if (process == 0)
		serve(ends[1]);
	close(ends[1]);
	if (process < 0) {
		close(ends[0]);
		return ERR_SYSTEM;
	}
	server.channel = ends[0];
	return 0;
}

static int send_request(const char *path, int pipe)
{
	union {
		struct cmsghdr head;
		char room[CMSG_SPACE(sizeof(int))];
	} control = { .head = { CMSG_LEN(sizeof(int)), SOL_SOCKET, SCM_RIGHTS } };
	struct iovec text = { (void *)path, strlen(path) };
	const struct msghdr message = {
		.msg_iov = &text, .msg_iovlen = 1, .msg_control = &control, .msg_controllen = sizeof(control)
	};

	memcpy(CMSG_DATA(&control.head), &pipe, sizeof(pipe));
	return sendmsg(server.channel, &message, MSG_NOSIGNAL) == (ssize_t)text.iov_len ? 0 : -1;
}

/* Request a picture. @return 0 or ERR_SYSTEM (reported) */
static int request(const char *path, int pipe)
{
	int err = 0;

	pthread_mutex_lock(&server.lock);
	if (server.channel >= 0 && send_request(path, pipe)) { /* the server was killed */
		close(server.channel);
		server.channel = -1;
		err = ERR_SYSTEM;
	}
	if (server.channel < 0) {
		err = start();
		if (!err && send_request(path, pipe))
			err = err_report(ERR_SYSTEM, path, "cannot be asked for: %s", strerror(errno));
	}
	pthread_mutex_unlock(&server.lock);
	return err;
}

static const char *take_text(struct cursor *c)
{
	const uint64_t n = cursor_u64(c);
	const char *text = n < UINT64_MAX ? cursor_get(c, n + 1) : NULL;

	if (text && text[n] == '\0')
		return text;
	c->failed = 1;
	return "";
}

/* Parse the picture of an answer, which is untrusted. @return 0; 1: it is incomplete; ERR_SYSTEM (reported) */
static int take_picture(struct cursor *c, FILE *in, struct image *img)
{
	const uint64_t width = cursor_u64(c), height = cursor_u64(c), n_channels = cursor_u64(c);
	const struct cursor names = *c;
	uint64_t n_attributes;

	if (width < 1 || height < 1 || width > MOST_PIXELS || height > MOST_PIXELS || width * height > MOST_PIXELS)
		return 1;
	img->width = (uint32_t)width;
	img->height = (uint32_t)height;
	for (uint64_t i = 0; i < n_channels && !c->failed; i++) {
		take_text(c);
		cursor_u64(c);
	}
	n_attributes = cursor_u64(c);
	for (uint64_t i = 0; i < n_attributes && !c->failed; i++) {
		const char *name = take_text(c), *text = take_text(c);

		if (image_set_attribute(img, name, "%s", text))
			return ERR_SYSTEM;
	}
	if (c->failed)
		return 1;
	*c = names;
	for (uint64_t i = 0; i < n_channels; i++) {
		const char *name = take_text(c);
		float *plane = strlen(name) < sizeof(img->channels[0].name) ? image_add_channel(img, name, cursor_u64(c) != 0) : NULL;

		if (!plane)
			return ERR_SYSTEM;
		if (fread(plane, sizeof(float), (size_t)(width * height), in) != width * height)
			return 1;
	}
	return 0;
}

/* Read an answer from the pipe. @return as foreign_read */
static int take_answer(FILE *in, struct image *img, const char *path)
{
	struct cursor c = { 0 };
	uint8_t *head = NULL;
	int64_t err;
	size_t n = 0;
	int got = 1;

	if (fread(&err, sizeof(err), 1, in) == 1 && fread(&n, sizeof(n), 1, in) == 1 && n <= (size_t)1 << 26 &&
	    (head = malloc(n + 1))) {
		c = (struct cursor){ .p = head, .end = head + n };
		if (fread(head, 1, n, in) == n)
			got = err ? (err == ERR_INPUT ? ERR_INPUT : ERR_SYSTEM) : take_picture(&c, in, img);
	}
	free(head);
	if (got > 0)
		got = err_report(ERR_INPUT, path, "OpenImageIO broke down over it: is the file damaged?");
	if (got)
		image_free(img);
	return got;
}

int foreign_read(struct image *img, const char *path)
{
	int ends[2], err;
	FILE *in;

	if (strlen(path) >= PATH_MAX || !*path)
		return err_report(ERR_INPUT, path, "no file can have that name");
	if (pipe2(ends, O_CLOEXEC))
		return err_report(ERR_SYSTEM, path, "cannot be read: %s", strerror(errno));
	err = request(path, ends[1]);
	close(ends[1]);
	in = err ? NULL : fdopen(ends[0], "rb");
	if (!in) {
		close(ends[0]);
		return err ? err : err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	err = take_answer(in, img, path);
	fclose(in);
	return err;
}
