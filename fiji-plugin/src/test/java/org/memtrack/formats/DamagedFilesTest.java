// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.memtrack.tracking.Interpolation;

/** Files that are not what they should be. */
class DamagedFilesTest {
    private static final String MODEL = "<TrackMate version=\"7.0.0\"><Model><AllSpots><SpotsInFrame frame=\"0\">";

    @TempDir
    Path folder;

    private Path file(String text) throws IOException {
        return Files.writeString(folder.resolve("file"), text);
    }

    @Test
    void aDocumentTypeIsRefusedAndNoEntityOfItIsOpened() throws IOException {
        Path secret = Files.writeString(folder.resolve("secret"), "top");
        Path xml = file("<!DOCTYPE TrackMate [<!ENTITY x SYSTEM \"%s\">]><TrackMate version=\"&x;\"/>"
                .formatted(secret.toUri()));

        assertThatThrownBy(() -> TrackMateXml.read(xml))
                .isInstanceOf(FormatException.class)
                .hasMessageContaining("document type")
                .hasMessageNotContaining("top");
    }

    @Test
    void entitiesThatGrowAreRefused() throws IOException {
        Path xml = file("<!DOCTYPE a [<!ENTITY b \"bbbb\"><!ENTITY c \"&b;&b;&b;\">]><TrackMate>&c;</TrackMate>");

        assertThatThrownBy(() -> TrackMateXml.read(xml)).isInstanceOf(FormatException.class);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '~',
            value = {
                "~~ | not well-formed",
                "not xml at all | not well-formed",
                "<TrackMate version='8'><Model> | not well-formed",
                "<Other/> | begins with <Other>",
                "<TrackMate version='8'/> | has no <Model>",
                "<TrackMate><Model><SpotsInFrame frame='x'/></Model></TrackMate> | says frame=\"x\"",
                "<TrackMate><Model><SpotsInFrame frame='0'><Spot ID='1' POSITION_Y='2'/></SpotsInFrame></Model></TrackMate>"
                        + " | has no POSITION_X",
                "<TrackMate><Model><Track TRACK_ID='0'><Edge SPOT_SOURCE_ID='1' SPOT_TARGET_ID='2'/></Track></Model>"
                        + "</TrackMate> | links the spots 1 and 2",
                "<Tracks><detection t='0' x='1' y='2'/></Tracks> | outside of a <particle>",
                "<Tracks><particle><detection t='-1' x='1' y='2'/></particle></Tracks> | negative frame -1"
            })
    void xmlThatIsNotTrackMatesIsNamed(String text, String message) throws IOException {
        Path xml = file(text);

        assertThatThrownBy(() -> TrackMateXml.read(xml))
                .isInstanceOf(FormatException.class)
                .hasMessageContaining(xml.toString())
                .hasMessageContaining(message);
    }

    @Test
    void oneSpotTwiceIsRefused() throws IOException {
        String spot = "<Spot ID=\"3\" POSITION_X=\"1\" POSITION_Y=\"2\"/>";
        Path xml = file(MODEL + spot + spot + "</SpotsInFrame></AllSpots></Model></TrackMate>");

        assertThatThrownBy(() -> TrackMateXml.read(xml)).hasMessageContaining("has the spot 3 twice");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '~',
            value = {
                "~~ | no file of MTrackJ",
                "Something else | no file of MTrackJ",
                "MTrackJ 1.6.0 Data File | versions up to 1.5.1",
                "MTrackJ 1.5.1 Data File\\nPoint 1 2 3 1 1 1 | line 2 has a point before",
                "MTrackJ 1.5.1 Data File\\nAssembly 1\\nTrack 1\\nPoint 1 2 three 1 1 1 | line 4 has \"three\"",
                "MTrackJ 1.5.1 Data File\\nTrack 1\\nPoint 1 2 3 1 | ends after 5 words",
                "MTrackJ 1.5.1 Data File\\nTrack 1\\nPoint 1 2 3 1 0 1 | has the time 0.0",
                "MTrackJ 1.5.1 Data File\\nTrack 1\\nPoint 1 2 NaN 1 1 1 | has \"NaN\"",
                "MTrackJ 1.5.1 Data File\\nTracks 1 | starts with \"Tracks\""
            })
    void anMdfThatIsNotOneIsNamed(String text, String message) throws IOException {
        Path mdf = file(text.replace("\\n", "\n"));

        assertThatThrownBy(() -> Mdf.read(mdf))
                .isInstanceOf(FormatException.class)
                .hasMessageContaining(message);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '~',
            value = {
                "~~ | is empty",
                "frame,x,y | no column \"track\"",
                "TID,x,y | no column \"pid\"",
                "track,frame,x,y\\n0,0,1,two | line 2 has \"two\" in the column \"y\"",
                "track,frame,x,y\\n0,1.5,1,2 | where a whole number belongs",
                "track,frame,x,y\\n0,-1,1,2 | where a frame from 0 belongs",
                "track,frame,x,y\\n0,4,1,2\\n0,4,1,2 | line 3",
                "track,frame,x,y\\n0,4,Infinity,2 | where a number belongs",
                "track,frame,x,y\\n0,4 | line 2 has \"\" in the column \"x\""
            })
    void aTableThatCannotBeReadIsNamed(String text, String message) throws IOException {
        Path csv = file(text.replace("\\n", "\n"));

        assertThatThrownBy(() -> TrackCsv.read(csv))
                .isInstanceOf(FormatException.class)
                .hasMessageContaining(csv.toString())
                .hasMessageContaining(message);
    }

    @Test
    void whateverHappensToAFileItIsReadOrRefusedWithAFormatException() throws IOException {
        TrackedFilm tracked = TrackedWorlds.of(1, true, Interpolation.FILL_GAPS).tracked();
        Path xml = folder.resolve("a.xml");
        Path mdf = folder.resolve("a.mdf");
        Path csv = folder.resolve("a.csv");
        TrackMateXml.write(xml, tracked);
        Mdf.write(mdf, tracked);
        TrackCsv.write(csv, tracked);
        Random random = new Random(5);
        int refused = 0;
        for (int i = 0; i < 120; i++) {
            Path source = new Path[] {xml, mdf, csv}[i % 3];
            byte[] bytes = Files.readAllBytes(source);
            for (int j = 0; j < 5; j++) {
                bytes[random.nextInt(bytes.length)] = (byte) random.nextInt(256);
            }
            Path damaged = Files.write(folder.resolve("damaged"), bytes);
            try {
                ImportedTracks read = source == xml
                        ? TrackMateXml.read(damaged)
                        : source == mdf ? Mdf.read(damaged) : TrackCsv.read(damaged);
                assertThat(read.spots()).isNotNull();
            } catch (FormatException e) {
                refused++;
            }
        }
        assertThat(refused).isBetween(12, 120);
    }

    @Test
    void aFileThatDoesNotExistIsAnIoException() {
        assertThatThrownBy(() -> TrackMateXml.read(folder.resolve("none.xml"))).isInstanceOf(IOException.class);
    }

    @Test
    void oldDialectsOfMdfAreRead() throws IOException {
        Path mdf = file(String.join(
                "\r\n",
                "MTrackJ 1.4.1 Data File ",
                "Displaying true true true 1 0 0 4 100 5 0 0 0 2 0 12 0 false false false false",
                "Offset 0 0 0 0 0",
                "Origin 1 2 3",
                "Assembly 1",
                "Cluster 1",
                "Track 1",
                "Point 1 1 1 1 1 1",
                "Assembly 2 FF0000",
                "Cluster 1 00FF00",
                "Track 7 0000FF true",
                "Point 1 10.5 20.25 1.0 2.0 1.0",
                "Point 2 11.5 21.25 1.0 2.0 1.0",
                "Point 3 12.5 22.25 1.0 3.4 1.0"));

        ImportedTracks read = Mdf.read(mdf);

        assertThat(read.tracks()).hasSize(1);
        assertThat(read.tracks().get(0).name()).isEqualTo("Cluster 1 Track 7");
        assertThat(read.tracks().get(0).spots()).extracting(ImportedSpot::frame).containsExactly(1, 2);
        assertThat(read.tracks().get(0).spots().get(0).x()).isEqualTo(11.5);
    }

    @Test
    void tablesOfSpreadsheetsAreRead() throws IOException {
        Path csv = folder.resolve("file");
        Files.write(
                csv, "\ufeff\"Track\";FRAME;\"X\";y;Score\r\n1;3;\"4.5\";6;\r\n\r\n".getBytes(StandardCharsets.UTF_8));

        ImportedTracks read = TrackCsv.read(csv);

        assertThat(read.spots()).hasSize(1);
        assertThat(read.spots().get(0).frame()).isEqualTo(3);
        assertThat(read.spots().get(0).x()).isEqualTo(4.5);
        assertThat(read.spots().get(0).score()).isEmpty();
    }
}
