// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.IOException;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import javax.xml.stream.XMLOutputFactory;
import javax.xml.stream.XMLStreamException;
import javax.xml.stream.XMLStreamWriter;

/** Writes XML in UTF-8, an element a line. */
final class IndentedXml {
    private final XMLStreamWriter writer;
    private int depth;

    /** Starts a document. */
    IndentedXml(OutputStream out) throws IOException {
        try {
            // The JDK's own, whatever else lies on the class path of Fiji.
            writer = XMLOutputFactory.newDefaultFactory().createXMLStreamWriter(out, StandardCharsets.UTF_8.name());
            writer.writeStartDocument(StandardCharsets.UTF_8.name(), "1.0");
        } catch (XMLStreamException e) {
            throw new IOException(e);
        }
    }

    /** Opens an element; attributes are names and values in turn. */
    void start(String element, String... attributes) throws IOException {
        write(element, false, attributes);
        depth++;
    }

    /** An element without content. */
    void empty(String element, String... attributes) throws IOException {
        write(element, true, attributes);
    }

    /** An element with text. */
    void text(String element, String text) throws IOException {
        write(element, false);
        try {
            writer.writeCharacters(valid(text));
            writer.writeEndElement();
        } catch (XMLStreamException e) {
            throw new IOException(e);
        }
    }

    /** Closes the element opened last. */
    void end() throws IOException {
        depth--;
        try {
            newLine();
            writer.writeEndElement();
        } catch (XMLStreamException e) {
            throw new IOException(e);
        }
    }

    /** Ends the document; the stream stays open. */
    void finish() throws IOException {
        try {
            writer.writeCharacters("\n");
            writer.writeEndDocument();
            writer.close();
        } catch (XMLStreamException e) {
            throw new IOException(e);
        }
    }

    private void write(String element, boolean empty, String... attributes) throws IOException {
        try {
            newLine();
            if (empty) {
                writer.writeEmptyElement(element);
            } else {
                writer.writeStartElement(element);
            }
            for (int i = 0; i < attributes.length; i += 2) {
                writer.writeAttribute(attributes[i], valid(attributes[i + 1]));
            }
        } catch (XMLStreamException e) {
            throw new IOException(e);
        }
    }

    private void newLine() throws XMLStreamException {
        writer.writeCharacters("\n" + "  ".repeat(depth));
    }

    /** Without the characters that XML 1.0 cannot hold. */
    private static String valid(String text) {
        if (text.chars().allMatch(c -> c >= 0x20 && c < 0xD800)) {
            return text;
        }
        StringBuilder valid = new StringBuilder();
        text.codePoints().map(c -> isValid(c) ? c : 0xFFFD).forEach(valid::appendCodePoint);
        return valid.toString();
    }

    private static boolean isValid(int c) {
        return c == '\n' || c == '\t' || c >= 0x20 && !(c >= 0xD800 && c <= 0xDFFF) && c != 0xFFFE && c != 0xFFFF;
    }
}
