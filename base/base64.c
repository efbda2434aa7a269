#include "base/base64.h"

#include <stdlib.h>

#include "base/err.h"

void base64_write(const uint8_t *bytes, size_t n, FILE *out)
{
	static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

	for (size_t i = 0; i < n; i += 3) {
		const size_t left = n - i;
		const uint32_t second = left > 1 ? bytes[i + 1] : 0, third = left > 2 ? bytes[i + 2] : 0;
		const uint32_t group = (uint32_t)bytes[i] << 16 | second << 8 | third;
		const char text[4] = { digits[group >> 18], digits[group >> 12 & 63], left > 1 ? digits[group >> 6 & 63] : '=',
		                       left > 2 ? digits[group & 63] : '=' };

		fwrite(text, 1, sizeof(text), out);
	}
}

char *base64_url(const char *type, const uint8_t *bytes, size_t n)
{
	char *text = NULL;
	size_t size;
	FILE *out = open_memstream(&text, &size);
	int failed = !out;

	if (out) {
		fprintf(out, "data:%s;base64,", type);
		base64_write(bytes, n, out);
		failed = fclose(out) != 0;
	}
	if (failed) {
		err_report(ERR_SYSTEM, NULL, "out of memory");
		free(text);
		return NULL;
	}
	return text;
}
