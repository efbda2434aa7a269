/* Runs inside the traced program. */
#include "capture/write/pages.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/uio.h>
#include <unistd.h>

enum { PAGE = 4096 };

/* For sandboxes that forbid process_vm_readv. */
static ssize_t copy_by_file(void *to, const void *from, size_t bytes)
{
	int fd = open("/proc/self/mem", O_RDONLY | O_CLOEXEC);
	ssize_t n = fd < 0 ? -1 : pread(fd, to, bytes, (off_t)(uintptr_t)from);

	if (fd >= 0)
		close(fd);
	return n;
}

/* One copy by the kernel. Returns its size, 0 if the start is unreadable. */
static size_t copy(void *to, const void *from, size_t bytes)
{
	struct iovec local = { to, bytes }, remote = { (void *)from, bytes };
	ssize_t n = process_vm_readv(getpid(), &local, 1, &remote, 1, 0);

	if (n < 0 && errno != EFAULT)
		n = copy_by_file(to, from, bytes);
	return n > 0 ? (size_t)n : 0;
}

size_t pages_read(void *to, const void *from, size_t bytes)
{
	const uintptr_t at = (uintptr_t)from; /* garbage may end beyond the last address */
	size_t done = 0, lost = 0;
	int saved = errno;

	while (done < bytes) {
		size_t page;

		done += copy((char *)to + done, (const void *)(at + done), bytes - done);
		if (done == bytes)
			break;
		/* The page at `done` is not there: zeros, and on with the next one. */
		page = PAGE - ((at + done) & (PAGE - 1));
		if (page > bytes - done)
			page = bytes - done;
		memset((char *)to + done, 0, page);
		done += page;
		lost += page;
	}
	errno = saved;
	return lost;
}

size_t pages_text_bytes(const char *text)
{
	char part[PAGE / 16]; /* a piece lies within one page, so it is readable as a whole or not at all */
	size_t bytes = 0;

	for (;;) {
		size_t n = sizeof(part) - (((uintptr_t)text + bytes) & (sizeof(part) - 1)), length;

		if (pages_read(part, text + bytes, n))
			return bytes;
		length = strnlen(part, n);
		bytes += length;
		if (length < n)
			return bytes;
	}
}

void *pages_map(size_t bytes)
{
	void *pages = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

	return pages == MAP_FAILED ? NULL : pages;
}

int pages_grow(uint8_t **pages, size_t *mapped, size_t bytes)
{
	size_t room = (bytes + 0xFFFF) & ~(size_t)0xFFFF;
	void *more;

	if (bytes <= *mapped)
		return 1;
	more = *pages ? mremap(*pages, *mapped, room, MREMAP_MAYMOVE) : pages_map(room);
	if (!more || more == MAP_FAILED)
		return 0;
	*pages = more;
	*mapped = room;
	return 1;
}
