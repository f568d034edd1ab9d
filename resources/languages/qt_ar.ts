<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<!-- What Qt says in Arabic otherwise than rvsim does, or not at all: pyside6-lrelease qt_ar.ts -->
<TS version="2.1" language="ar">
<context><name>QFileDialog</name>
<message><source>&amp;Look in:</source><translation>&amp;ابحث في:</translation></message>
<message><source>Files of &amp;type:</source><translation>&amp;نوع الملفات:</translation></message>
<message><source>&amp;Open</source><translation>ف&amp;تح</translation></message>
<message><source>&amp;Save</source><translation>ح&amp;فظ</translation></message>
<message><source>&amp;Choose</source><translation>ا&amp;ختيار</translation></message>
<message><source>Open</source><translation>فتح</translation></message>
<message><source>Save As</source><translation>حفظ باسم</translation></message>
</context>
<context><name>QAbstractFileIconProvider</name>
<message><source>Folder</source><translation>مجلد</translation></message>
<message><source>File Folder</source><translation>مجلد</translation></message>
<message><source>File</source><translation>ملف</translation></message>
<message><source>%1 File</source><translation>ملف %1</translation></message>
<message><source>Drive</source><translation>قرص</translation></message>
<message><source>Shortcut</source><translation>اختصار</translation></message>
<message><source>Alias</source><translation>اسم بديل</translation></message>
<message><source>Unknown</source><translation>غير معروف</translation></message>
</context>
<context><name>QPlatformTheme</name>
<message><source>OK</source><translation>حسنًا</translation></message>
<message><source>Save</source><translation>حفظ</translation></message>
<message><source>Save All</source><translation>حفظ الكل</translation></message>
<message><source>Open</source><translation>فتح</translation></message>
<message><source>Cancel</source><translation>إلغاء</translation></message>
<message><source>Close</source><translation>إغلاق</translation></message>
<message><source>Discard</source><translation>عدم الحفظ</translation></message>
<message><source>Apply</source><translation>تطبيق</translation></message>
<message><source>Reset</source><translation>إعادة ضبط</translation></message>
<message><source>Yes</source><translation>نعم</translation></message>
<message><source>No</source><translation>لا</translation></message>
<message><source>&amp;Yes</source><translation>&amp;نعم</translation></message>
<message><source>&amp;No</source><translation>&amp;لا</translation></message>
<message><source>Help</source><translation>مساعدة</translation></message>
</context>
<context><name>QDockWidget</name>
<message><source>Close</source><translation>إغلاق</translation></message>
<message><source>Float</source><translation>فصل</translation></message>
</context>
</TS>
