/* Picture headers that claim more data than the file has are refused; honest ones pass. That readers allocate no
 * memory for them is tested by tests/fuzz/kept_oiio. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "tests/case.h"
#include "tracer/image/heads.h"

#define GIB "\x40\0\0\0"
#define GIB_LITTLE "\0\0\0\x40"
#define PNG "\x89PNG\r\n\x1a\n"
#define PNG_SIZE "\0\0\0\x0dIHDR\0\0\0\x10\0\0\0\x10\x08\x02\0\0\0\x90\x91\x68\x36"
#define EXR "\x76\x2f\x31\x01\x02\0\0\0"
#define EXR_PARTS "\x76\x2f\x31\x01\x02\x10\0\0"
#define EXR_TEXT "first\0string\0\x05\0\0\0plain"

static char path[] = "/tmp/test_heads.XXXXXX";

static void write_file(const void *bytes, size_t n)
{
	FILE *file = fopen(path, "wb");

	ck_assert_ptr_nonnull(file);
	ck_assert_uint_eq(fwrite(bytes, 1, n, file), n);
	ck_assert_int_eq(fclose(file), 0);
}

/* The bytes of a literal, without its NUL. */
#define WRITE(literal) write_file(literal, sizeof(literal) - 1)

static void check_refused(void)
{
	ck_assert_int_eq(heads_check(path), ERR_INPUT);
}

START_TEST(lengths_beyond_the_end)
{
	uint8_t dpx[2048] = "XPDS";

	WRITE(PNG PNG_SIZE GIB "iCCP____");
	check_refused();
	WRITE(EXR EXR_TEXT "second\0string\0" GIB_LITTLE "text");
	check_refused();
	WRITE(EXR_PARTS EXR_TEXT "\0" EXR_TEXT "second\0string\0" GIB_LITTLE "text");
	check_refused();
	WRITE(EXR "lines\0lineOrder\0\x02\0\0\0\0\0" EXR_TEXT "\0"); /* a byte is read, and text follows */
	check_refused();
	WRITE(EXR EXR_TEXT "second\0string\0\x05\0\0\0text");
	check_refused();
	memcpy(dpx + 32, GIB_LITTLE, 4);
	write_file(dpx, sizeof(dpx));
	check_refused();
	memcpy(dpx, "SDPX", 4);
	memcpy(dpx + 32, GIB, 4);
	write_file(dpx, sizeof(dpx));
	check_refused();
	WRITE("GIF89a\xff\xff\xff\xff\x80\0\0");
	check_refused();
	WRITE("\0\0\1\0\1\0\x10\x10"); /* an icon */
	check_refused();
	unlink(path);
}
END_TEST

START_TEST(other_files_pass)
{
	uint8_t dpx[2048] = "SDPX";

	WRITE(PNG PNG_SIZE "\0\0\0\x08tEXta\0plain\0____");
	ck_assert_int_eq(heads_check(path), 0);
	WRITE(PNG PNG_SIZE "\0\0\x10\0IDATcut"); /* libpng reports the fault */
	ck_assert_int_eq(heads_check(path), 0);
	WRITE(EXR "lines\0lineOrder\0\x01\0\0\0\0" EXR_TEXT "\0" GIB_LITTLE GIB_LITTLE GIB_LITTLE); /* chunk offsets */
	ck_assert_int_eq(heads_check(path), 0);
	WRITE(EXR_PARTS EXR_TEXT "\0" EXR_TEXT "\0\0" "a\0b\0" GIB_LITTLE);
	ck_assert_int_eq(heads_check(path), 0);
	WRITE("SDPX");
	ck_assert_int_eq(heads_check(path), 0);
	WRITE("GIF89a\0\x08\0\x08\x80\0\0"); /* 2048 x 2048 */
	ck_assert_int_eq(heads_check(path), 0);
	memcpy(dpx + 32, "\xff\xff\xff\xff", 4);
	write_file(dpx, sizeof(dpx));
	ck_assert_int_eq(heads_check(path), 0);
	memcpy(dpx + 32, "\0\0\x01\0", 4);
	write_file(dpx, sizeof(dpx));
	ck_assert_int_eq(heads_check(path), 0);
	unlink(path);
	ck_assert_int_eq(heads_check(path), 0); /* a missing file is reported elsewhere */
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("heads");

	close(mkstemp(path));
	tcase_set_timeout(tcase, 60);
	tcase_add_test(tcase, lengths_beyond_the_end);
	tcase_add_test(tcase, other_files_pass);
	return run_case(tcase, "heads");
}
