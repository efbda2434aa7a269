#include "tracer/image/exr_out.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

static void write_at(struct exr_out *out, const unsigned char *bytes, size_t n, uint64_t at)
{
	while (n && !out->reason) {
		const ssize_t written = pwrite(out->file, bytes, n, (off_t)at);

		if (written < 0 && errno == EINTR)
			continue;
		if (written <= 0) {
			out->reason = written ? errno : EIO;
			return;
		}
		bytes += written;
		n -= (size_t)written;
		at += (uint64_t)written;
	}
}

static void flush(struct exr_out *out)
{
	write_at(out, out->bytes, out->n, out->at);
	out->n = 0;
}

/* Write function of OpenEXRCore (exr_write_func_ptr_t). */
static int64_t take(exr_const_context_t context, void *user, const void *buffer, uint64_t n, uint64_t at,
                    exr_stream_error_func_ptr_t fail)
{
	struct exr_out *out = user;

	if (at != out->at + out->n || n > EXR_OUT_BYTES - out->n)
		flush(out);
	if (n >= EXR_OUT_BYTES) {
		write_at(out, buffer, n, at);
	} else {
		if (out->n == 0)
			out->at = at;
		memcpy(out->bytes + out->n, buffer, n);
		out->n += n;
	}
	if (!out->reason)
		return (int64_t)n;
	fail(context, EXR_ERR_WRITE_IO, "%s", strerror(out->reason));
	return -1;
}

int exr_out_open(struct exr_out *out, const char *path, exr_context_initializer_t *setup)
{
	out->n = 0;
	out->at = 0;
	out->file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
	out->reason = out->file < 0 ? errno : 0;
	setup->user_data = out;
	setup->write_fn = take;
	return out->reason ? -1 : 0;
}

int exr_out_close(struct exr_out *out)
{
	flush(out);
	if (close(out->file) && !out->reason)
		out->reason = errno;
	return out->reason ? -1 : 0;
}
