// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.server;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.zip.ZipEntry;
import java.util.zip.ZipOutputStream;

/** A package memtrack without dependencies, so that it installs without a network. */
final class SmallWheel {
    /** Greets as the server does, and ends when its input does. */
    static final String SERVER = """
            import json, os, sys
            print(json.dumps({"protocol": 1, "port": 1, "pid": os.getpid(), "version": "9.9.9"}), flush=True)
            sys.stdin.read()
            """;

    private SmallWheel() {}

    /**
     * Makes the wheel.
     *
     * @param main code of {@code python -m memtrack}
     * @param python which Pythons may install it
     */
    static ServerWheel of(String main, String python) throws IOException {
        ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        try (ZipOutputStream zip = new ZipOutputStream(bytes)) {
            add(zip, "memtrack/__init__.py", "");
            add(zip, "memtrack/__main__.py", main);
            add(zip, "memtrack-9.9.9.dist-info/METADATA", """
                    Metadata-Version: 2.1
                    Name: memtrack
                    Version: 9.9.9
                    Requires-Python: %s
                    Provides-Extra: train
                    """.formatted(python));
            add(
                    zip,
                    "memtrack-9.9.9.dist-info/WHEEL",
                    "Wheel-Version: 1.0\nGenerator: test\nRoot-Is-Purelib: true\nTag: py3-none-any\n");
            add(zip, "memtrack-9.9.9.dist-info/RECORD", """
                    memtrack/__init__.py,,
                    memtrack/__main__.py,,
                    memtrack-9.9.9.dist-info/METADATA,,
                    memtrack-9.9.9.dist-info/WHEEL,,
                    memtrack-9.9.9.dist-info/RECORD,,
                    """);
        }
        return new ServerWheel("memtrack-9.9.9-py3-none-any.whl", bytes.toByteArray());
    }

    private static void add(ZipOutputStream zip, String name, String content) throws IOException {
        zip.putNextEntry(new ZipEntry(name));
        zip.write(content.getBytes(StandardCharsets.UTF_8));
        zip.closeEntry();
    }
}
