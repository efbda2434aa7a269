/* Text from a recording written as JSON: the result must be a single JSON string of well-formed UTF-8 for any input. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "tests/fuzz/target.h"

/* RFC 3629: the number of bytes of a character, or 0 if none is well-formed here */
static size_t character(const unsigned char *p, const unsigned char *end)
{
	size_t n = p[0] < 0x80                 ? 1 :
	           p[0] >= 0xc2 && p[0] < 0xe0 ? 2 :
	           (p[0] & 0xf0) == 0xe0       ? 3 :
	           p[0] >= 0xf0 && p[0] < 0xf5 ? 4 :
	                                         0;

	if (n == 0 || (size_t)(end - p) < n)
		return 0;
	for (size_t i = 1; i < n; i++)
		if ((p[i] & 0xc0) != 0x80)
			return 0;
	if ((p[0] == 0xe0 && p[1] < 0xa0) || (p[0] == 0xed && p[1] > 0x9f) || (p[0] == 0xf0 && p[1] < 0x90) ||
	    (p[0] == 0xf4 && p[1] > 0x8f))
		return 0;
	return n;
}

static void check_string(const unsigned char *p, const unsigned char *end)
{
	if (end - p < 2 || *p++ != '"' || *--end != '"')
		abort();
	while (p < end) {
		size_t n = character(p, end);

		if (n == 0 || *p == '"' || *p < 0x20)
			abort();
		if (*p == '\\' &&
		    (end - p < 2 || !strchr("\"\\/bfnrtu", p[1]) ||
		     (p[1] == 'u' && (end - p < 6 || strspn((const char *)p + 2, "0123456789abcdef") < 4))))
			abort();
		p += *p == '\\' ? 2 : n;
	}
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	char *text = calloc(size + 1, 1), *written = NULL;
	size_t n = 0;
	FILE *out = open_memstream(&written, &n);
	struct json j = { .out = out };

	if (!text || !out)
		abort();
	memcpy(text, data, size);
	json_string(&j, text);
	if (fclose(out))
		abort();
	check_string((const unsigned char *)written, (const unsigned char *)written + n);
	free(written);
	free(text);
	return 0;
}
