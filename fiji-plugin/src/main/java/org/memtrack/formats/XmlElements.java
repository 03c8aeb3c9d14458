// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.io.InputStream;
import java.io.InputStreamReader;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.Optional;
import java.util.OptionalDouble;
import javax.xml.stream.XMLInputFactory;
import javax.xml.stream.XMLStreamConstants;
import javax.xml.stream.XMLStreamException;
import javax.xml.stream.XMLStreamReader;

/**
 * The elements of an XML file, one after the other, with their attributes as numbers.
 *
 * <p>A document type is refused, and with it every entity a stranger's file might define.
 */
final class XmlElements {
    private final Path source;
    private final XMLStreamReader reader;

    XmlElements(Path source, InputStream in) throws FormatException {
        this.source = source;
        // The JDK's own, whatever else lies on the class path of Fiji.
        XMLInputFactory factory = XMLInputFactory.newDefaultFactory();
        factory.setProperty(XMLInputFactory.SUPPORT_DTD, false);
        factory.setProperty(XMLInputFactory.IS_SUPPORTING_EXTERNAL_ENTITIES, false);
        try {
            // Decoded here, as TrackMate writes it: the JDK's XML reader prints to the console what bytes it dislikes.
            reader = factory.createXMLStreamReader(new InputStreamReader(in, StandardCharsets.UTF_8.newDecoder()));
        } catch (XMLStreamException e) {
            throw damaged(e);
        }
    }

    /** Goes to the start of the next element; false at the end of the file. */
    boolean next() throws FormatException {
        try {
            while (reader.hasNext()) {
                int event = reader.next();
                if (event == XMLStreamConstants.DTD) {
                    throw wrong("has a document type, which TrackMate never writes");
                }
                if (event == XMLStreamConstants.START_ELEMENT) {
                    return true;
                }
            }
            return false;
        } catch (XMLStreamException e) {
            throw damaged(e);
        }
    }

    /** Name of the present element. */
    String name() {
        return reader.getLocalName();
    }

    Optional<String> text(String attribute) {
        return Optional.ofNullable(reader.getAttributeValue(null, attribute));
    }

    /** A finite number; empty when the attribute is missing or NaN. */
    OptionalDouble number(String attribute) throws FormatException {
        String text = reader.getAttributeValue(null, attribute);
        if (text == null || text.equals("NaN")) {
            return OptionalDouble.empty();
        }
        try {
            double value = Double.parseDouble(text);
            if (Double.isFinite(value)) {
                return OptionalDouble.of(value);
            }
        } catch (NumberFormatException noNumber) {
            // Said below.
        }
        throw wrong("says %s=\"%s\" where a number belongs".formatted(attribute, text));
    }

    double requiredNumber(String attribute) throws FormatException {
        OptionalDouble value = number(attribute);
        if (value.isEmpty()) {
            throw wrong("has no %s in its <%s>".formatted(attribute, name()));
        }
        return value.getAsDouble();
    }

    /** A whole number, also when it is written as 3.0. */
    int requiredInteger(String attribute) throws FormatException {
        double value = requiredNumber(attribute);
        if (value != Math.rint(value) || Math.abs(value) > Integer.MAX_VALUE) {
            throw wrong("says %s=\"%s\" where a whole number belongs".formatted(attribute, value));
        }
        return (int) value;
    }

    /** What to throw when the file is not as it should be at the present place. */
    FormatException wrong(String what) {
        return new FormatException("%s, line %d: the file %s; export it from TrackMate again"
                .formatted(source, reader.getLocation().getLineNumber(), what));
    }

    private FormatException damaged(XMLStreamException cause) {
        String where = cause.getLocation() == null
                ? ""
                : ", line %d".formatted(cause.getLocation().getLineNumber());
        return new FormatException(
                "%s%s: the file is not well-formed XML; export it from TrackMate again".formatted(source, where),
                cause);
    }
}
